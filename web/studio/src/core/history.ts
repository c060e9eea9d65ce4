// Undo and redo over documents that do not change.

const kMostKept = 200;

export class History<T> {
  private readonly past: T[] = [];
  private readonly future: T[] = [];
  private mark: string | undefined;

  constructor(private present: T) {}

  get value(): T {
    return this.present;
  }
  get canUndo(): boolean {
    return this.past.length > 0;
  }
  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** A change. Several with the same `gesture` in a row (the ticks of one slider) are undone together. */
  push(value: T, gesture?: string): void {
    if (gesture === undefined || gesture !== this.mark) {
      this.past.push(this.present);
      if (this.past.length > kMostKept) this.past.shift();
    }
    this.mark = gesture;
    this.present = value;
    this.future.length = 0;
  }
  /** The gesture is over: the next one is undone apart. */
  settle(): void {
    this.mark = undefined;
  }
  undo(): boolean {
    const value = this.past.pop();
    if (value === undefined) return false;
    this.future.push(this.present);
    this.present = value;
    this.mark = undefined;
    return true;
  }
  redo(): boolean {
    const value = this.future.pop();
    if (value === undefined) return false;
    this.past.push(this.present);
    this.present = value;
    this.mark = undefined;
    return true;
  }
}
