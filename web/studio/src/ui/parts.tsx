// Small parts that the panels share.
import type { ComponentChildren } from "preact";
import { useRef, useState } from "preact/hooks";
import { Check, Copy, type LucideIcon, RotateCcw } from "lucide-preact";

export type Icon = LucideIcon;

export function IconButton(props: {
  icon: Icon;
  label: string;
  onClick: () => void;
  pressed?: boolean;
  disabled?: boolean;
  class?: string;
  shortcut?: string;
}) {
  const { icon: Picture, label, shortcut } = props;
  return (
    <button
      type="button"
      class={`icon-button ${props.class ?? ""}`}
      aria-label={label}
      disabled={props.disabled ?? false}
      title={shortcut === undefined ? label : `${label} (${shortcut})`}
      onClick={props.onClick}
      {...(props.pressed !== undefined && { "aria-pressed": props.pressed })}
    >
      <Picture size="1.15em" aria-hidden="true" />
    </button>
  );
}

export function Segmented<T extends string>(props: {
  label: string;
  value: T;
  options: readonly { value: T; text: string }[];
  onChange: (value: T) => void;
}) {
  return (
    <div class="segmented" role="group" aria-label={props.label}>
      {props.options.map(({ value, text }) => (
        <button key={value} type="button" aria-pressed={value === props.value} onClick={() => props.onChange(value)}>
          {text}
        </button>
      ))}
    </div>
  );
}

export function Section({
  title,
  children,
  aside,
}: {
  title: string;
  children: ComponentChildren;
  aside?: ComponentChildren;
}) {
  return (
    <section class="section">
      <header>
        <h3>{title}</h3>
        {aside}
      </header>
      {children}
    </section>
  );
}

export function CopyButton({ text, label }: { text: () => string; label: string }) {
  const [copied, setCopied] = useState(false);
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(text());
    } catch {
      return;
    }
    setCopied(true);
    setTimeout(() => setCopied(false), 1600);
  };
  return (
    <button type="button" class="button" onClick={() => void copy()}>
      {copied ? <Check size="1.1em" aria-hidden="true" /> : <Copy size="1.1em" aria-hidden="true" />}
      {copied ? "Copied" : label}
    </button>
  );
}

/** A number with a slider. `toShare` and `fromShare` bend the slider's way (0 to 1). */
export function NumberSlider(props: {
  label: string;
  symbol?: string;
  unit?: string;
  hint: string;
  value: number;
  minimum: number;
  maximum: number;
  toShare: (value: number) => number;
  fromShare: (share: number) => number;
  onInput: (value: number) => void;
  onSettle: () => void;
  onReset: (() => void) | null;
  extra?: ComponentChildren;
  disabled?: boolean;
}) {
  const id = useRef(`slider-${props.label.replace(/\W/g, "-")}`).current;
  const enter = (text: string) => {
    const value = Number(text);
    if (text.trim() === "" || !Number.isFinite(value)) return;
    props.onInput(Math.min(Math.max(value, props.minimum), props.maximum));
    props.onSettle();
  };
  return (
    <div class="slider-row">
      <div class="slider-head">
        <label for={id} title={props.hint}>
          {props.label}
          {props.symbol ? (
            <span class="symbol" aria-hidden="true">
              {" "}
              {props.symbol}
            </span>
          ) : null}
        </label>
        {props.extra}
        {props.onReset === null ? null : (
          <button
            type="button"
            class="reset"
            aria-label={`Reset ${props.label}`}
            title="Back to the default"
            onClick={props.onReset}
          >
            <RotateCcw size="0.9em" aria-hidden="true" />
          </button>
        )}
        <input
          class="number"
          type="text"
          inputMode="decimal"
          value={shortened(props.value)}
          disabled={props.disabled ?? false}
          aria-label={`${props.label}${props.unit ? `, ${props.unit}` : ""}`}
          onChange={(event) => enter(event.currentTarget.value)}
        />
        <span class="unit">{props.unit}</span>
      </div>
      <input
        id={id}
        type="range"
        min="0"
        max="1"
        step="0.001"
        value={props.toShare(props.value)}
        aria-describedby={`${id}-hint`}
        aria-valuetext={`${shortened(props.value)} ${props.unit ?? ""}`}
        disabled={props.disabled ?? false}
        onInput={(event) => props.onInput(props.fromShare(Number(event.currentTarget.value)))}
        onChange={props.onSettle}
      />
      <p class="hint" id={`${id}-hint`}>
        {props.hint}
      </p>
    </div>
  );
}

export function shortened(value: number): string {
  return String(Number(value.toPrecision(4)));
}
