// Shapes: convex solids about their centroid, principal axis along x.
import { core, type Id, type Vector } from "./core.js";
import { layout } from "./generated/layout.js";

export type ShapeKind = "sphere" | "box" | "cylinder" | "cone" | "capsule" | "hull";
const kinds: readonly ShapeKind[] = ["sphere", "box", "cylinder", "cone", "capsule", "hull"];

function destroy(id: Id): void {
  core().plain("elastoonShapeDestroy", core().putId(id));
}
const forgotten = new FinalizationRegistry<Id>(destroy);
/** By content: bodies of a scene that are shaped alike share one object. */
const shared = new Map<bigint, WeakRef<Shape>>();

/** A convex solid. Bodies and obstacles keep theirs: a shape that nobody needs any more goes away by itself. */
export class Shape {
  readonly kind: ShapeKind;
  /** Full extent along the principal axis, m. */
  readonly length: number;
  /** m^3; a deformation does not change it. */
  readonly volume: number;
  /** Full extents along x, y, z, m. */
  readonly extents: Readonly<Vector>;
  /** Where the centroid lay among the points given to `hull`. */
  readonly centroidOfInput: Readonly<Vector>;
  /** Greatest distance of a vertex from the centroid, m. */
  readonly boundingRadius: number;
  /** @internal */
  readonly id: Id;

  private disposed = false;

  /** @internal */
  constructor(id: Id) {
    const c = core();
    const info = c.take(layout.ShapeInfo.size);
    c.call("elastoonShapeInfo", c.putId(id), info);
    this.id = id;
    this.kind = kinds[c.u32(info)] ?? "hull";
    this.length = c.f64(info + layout.ShapeInfo.length);
    this.volume = c.f64(info + layout.ShapeInfo.volume);
    this.boundingRadius = c.f64(info + layout.ShapeInfo.bounding_radius);
    this.extents = c.vector(info + layout.ShapeInfo.extents);
    this.centroidOfInput = c.vector(info + layout.ShapeInfo.centroid_of_input);
    forgotten.register(this, id, this);
  }

  /** @internal The shape of an id that is ours: the object that is there already, if there is one. */
  static ofId(id: Id): Shape {
    const c = core();
    const info = c.take(layout.ShapeInfo.size);
    c.call("elastoonShapeInfo", c.putId(id), info);
    const hash = c.data.getBigUint64(info + layout.ShapeInfo.content_hash, true);
    const known = shared.get(hash)?.deref();
    if (known !== undefined && !known.disposed) {
      destroy(id);
      return known;
    }
    const shape = new Shape(id);
    shared.set(hash, new WeakRef(shape));
    return shape;
  }

  private static make(name: string, ...sizes: number[]): Shape {
    const c = core();
    const out = c.take(layout.Shape.size);
    c.call(name, ...sizes, out);
    return new Shape(c.id(out));
  }

  /** Ball; an octahedron's faces cut in `cuts` (a multiple of 2, 2 to 64). */
  static ball(radius: number, cuts = 8): Shape {
    return Shape.make("elastoonShapeSphere", radius, cuts);
  }
  /** Box with full edge lengths. */
  static box(x: number, y: number, z: number): Shape {
    return Shape.make("elastoonShapeBox", x, y, z);
  }
  /** Cylinder along x; `sides` a multiple of 4, 8 to 256. */
  static cylinder(radius: number, length: number, sides = 32): Shape {
    return Shape.make("elastoonShapeCylinder", radius, length, sides);
  }
  /** Cone along x, its tip towards +x. */
  static cone(radius: number, length: number, sides = 32): Shape {
    return Shape.make("elastoonShapeCone", radius, length, sides);
  }
  /** Capsule along x: `length` from tip to tip, at least 2 radius; `sides` a multiple of 4, 8 to 64. */
  static capsule(radius: number, length: number, sides = 16): Shape {
    return Shape.make("elastoonShapeCapsule", radius, length, sides);
  }
  /** Convex hull of points, x y z after x y z, moved so that its centroid is the origin. */
  static hull(points: ArrayLike<number>): Shape {
    const c = core();
    const numbers = Float64Array.from(points);
    return c.withBytes(new Uint8Array(numbers.buffer), (at) => {
      const out = c.take(layout.Shape.size);
      c.call("elastoonShapeHull", at, Math.floor(numbers.length / 3), out);
      return new Shape(c.id(out));
    });
  }

  /** x y z of each vertex. */
  vertices(): Float32Array {
    const bytes = this.list("elastoonShapeVertices", layout.Vec3.size);
    return Float32Array.from(new Float64Array(bytes.buffer));
  }

  /** Three indices of vertices for each triangle, counter-clockwise seen from outside. */
  triangles(): Uint32Array {
    return new Uint32Array(this.list("elastoonShapeTriangles", 4).buffer);
  }

  private list(name: string, size: number): Uint8Array {
    const c = core();
    let out = c.take(4);
    c.call(name, c.putId(this.id), 0, 0, out);
    const count = c.u32(out);
    const at = c.allocate(Math.max(count * size, 1));
    try {
      out = c.take(4);
      c.call(name, c.putId(this.id), at, count, out);
      return c.u8.slice(at, at + count * size);
    } finally {
      c.free(at);
    }
  }

  /** Gives its memory back now, where waiting for the garbage collector is not wanted. */
  dispose(): void {
    this.disposed = true;
    if (forgotten.unregister(this)) destroy(this.id);
  }
}
