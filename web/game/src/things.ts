// Blocks, paddle and balls in three.js: one draw call for each kind, placed from the rules' list of what is drawn.
import { BufferGeometry, CatmullRomCurve3, Color, ExtrudeGeometry, Group, InstancedMesh, Matrix4, Mesh,
  MeshBasicMaterial,
  MeshStandardMaterial, PlaneGeometry, Shape, SphereGeometry, TubeGeometry, Vector2, Vector3 } from "three";
import { RoundedBoxGeometry } from "three/examples/jsm/geometries/RoundedBoxGeometry.js";
import { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { patterned } from "../../stage/src/patterns.ts";
import { type BlockKind, blockKinds, drawnWhat, type Game, kDrawnFloats, type Sizes } from "./engine.ts";
import { blockColors, palette, rowColors, signTexture } from "./looks.ts";

const kMost = 200; // of one kind
const kTopRow = 15.2, kRowPitch = 0.64; // to give rows their colours

/** Instances that are filled anew each frame. */
class Batch {
  readonly mesh: InstancedMesh;
  constructor(group: Group, geometry: BufferGeometry, material: MeshStandardMaterial | MeshBasicMaterial, shadow = true,
    most = kMost) {
    this.mesh = new InstancedMesh(geometry, material, most);
    this.mesh.count = 0;
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = shadow;
    this.mesh.receiveShadow = shadow;
    group.add(this.mesh);
  }
  begin(): void {
    this.mesh.count = 0;
  }
  add(matrix: Matrix4, color?: Color): void {
    if (this.mesh.count >= this.mesh.instanceMatrix.count) return;
    this.mesh.setMatrixAt(this.mesh.count, matrix);
    if (color !== undefined) this.mesh.setColorAt(this.mesh.count, color);
    this.mesh.count += 1;
  }
  end(): void {
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor !== null) this.mesh.instanceColor.needsUpdate = true;
  }
}

interface KindView {
  readonly solid: Batch;
  readonly signs: Partial<Record<"whole" | "cracked", Batch>>;
}

/** The solid's outline, its corners rounded within it. */
function paddleGeometry(outline: Float32Array): BufferGeometry {
  const points: Vector2[] = [];
  for (let i = 0; i < outline.length; i += 2) points.push(new Vector2(outline[i], outline[i + 1]));
  const shape = new Shape();
  const kRound = 0.2; // of the corners, m
  points.forEach((corner, i) => {
    const towards = (other: Vector2) => {
      const way = other.clone().sub(corner);
      return corner.clone().addScaledVector(way, Math.min(0.5, kRound / way.length()));
    };
    const from = towards(points.at(i - 1)!);
    const to = towards(points[(i + 1) % points.length]!);
    if (i === 0) shape.moveTo(from.x, from.y);
    else shape.lineTo(from.x, from.y);
    shape.quadraticCurveTo(corner.x, corner.y, to.x, to.y);
  });
  shape.closePath();
  const bevel = 0.06;
  const geometry = new ExtrudeGeometry(shape, { depth: 0.9, bevelEnabled: true, bevelSize: bevel, bevelThickness: bevel,
    bevelOffset: -bevel, bevelSegments: 4, curveSegments: 6 });
  return toCreasedNormals(geometry.translate(0, 0, -0.45), 0.6);
}

export class Things {
  readonly group = new Group();
  private readonly kinds = new Map<BlockKind, KindView>();
  private readonly ball: Batch;
  private readonly trail: Batch;
  private readonly egg: Batch;
  private readonly fuse: Batch;
  private readonly paddle = new Group();
  private paddleMeshes: Mesh[] = [];
  private paddleWidth = 0;
  private shownWidth = 0;
  private readonly trails = new Map<number, Matrix4[]>();
  private readonly matrix = new Matrix4();
  private readonly color = new Color();
  private readonly paddleMaterial = new MeshStandardMaterial({ color: palette.paddle, roughness: 0.55 });
  private readonly bandMaterial = new MeshStandardMaterial({ color: palette.paddleStripe, roughness: 0.5 });

  constructor(sizes: Sizes) {
    const { blockWidth: w, blockHeight: h, blockDepth: d, roundRadius: r, ballRadius } = sizes;
    const box = new RoundedBoxGeometry(w, h, d, 4, 0.13);
    const round = new SphereGeometry(r, 32, 24);
    const face = new PlaneGeometry(w * 0.92, h * 0.9).translate(0, 0, d / 2 + 0.004);
    const aspect = (w * 0.92) / (h * 0.9);
    for (const kind of blockKinds) {
      const is_round = kind === "explosive" || kind === "ball";
      const clear = kind === "ball" ? 0.42 : kind === "jelly" ? 0.86 : 1;
      const material = new MeshStandardMaterial({
        color: kind === "plain" ? 0xffffff : blockColors[kind],
        roughness: kind === "jelly" || is_round ? 0.22 : kind === "tough" ? 0.38 : kind === "stone" ? 0.95 : 0.6,
        metalness: kind === "tough" ? 0.35 : 0,
        transparent: clear < 1,
        opacity: clear,
      });
      const signs: KindView["signs"] = {};
      for (const [which, of_kind] of [["whole", kind], ["cracked", "cracked"]] as const) {
        if (which === "cracked" && kind !== "tough") continue;
        const map = signTexture(of_kind, aspect);
        if (map === undefined) continue;
        signs[which] = new Batch(this.group, face, new MeshBasicMaterial({ map, transparent: true,
          depthWrite: false }), false);
        signs[which].mesh.renderOrder = 2;
      }
      this.kinds.set(kind, { solid: new Batch(this.group, is_round ? round : box, material), signs });
    }
    const ball = new SphereGeometry(ballRadius, 40, 28).rotateZ(-Math.PI / 2);
    this.ball = new Batch(this.group, ball, patterned("two-tone", [ballRadius, ballRadius, ballRadius], palette.cream),
      true, 12);
    this.egg = new Batch(this.group, new SphereGeometry(r * 0.55, 20, 16),
      new MeshStandardMaterial({ color: palette.ball, roughness: 0.4 }), false, 40);
    const stem = new TubeGeometry(new CatmullRomCurve3([new Vector3(0.06, r * 0.85, 0), new Vector3(0.1, r * 1.2, 0),
      new Vector3(0.2, r * 1.3, 0)]), 8, 0.035, 6);
    this.fuse = new Batch(this.group, stem, new MeshStandardMaterial({ color: 0xd8c49a, roughness: 0.9 }), false, 80);
    this.trail = new Batch(this.group, new SphereGeometry(ballRadius, 20, 14),
      new MeshBasicMaterial({ color: palette.ball,
      transparent: true, opacity: 0.13, depthWrite: false }), false, 140);
    this.group.add(this.paddle);
  }

  private buildPaddle(game: Game, half_width: number): void {
    for (const mesh of this.paddleMeshes) mesh.geometry.dispose();
    this.paddle.clear();
    const body = new Mesh(paddleGeometry(game.paddleOutline(half_width)), this.paddleMaterial);
    // Two bands, so that its squash can be seen.
    const bands = [-1, 1].map((side) => {
      const band = new Mesh(new RoundedBoxGeometry(0.22, 0.46, 1.03, 3, 0.06), this.bandMaterial);
      band.position.set(side * half_width * 0.52, 0.255, 0);
      return band;
    });
    this.paddleMeshes = [body, ...bands];
    for (const mesh of this.paddleMeshes) {
      mesh.castShadow = mesh.receiveShadow = true;
      this.paddle.add(mesh);
    }
    this.paddle.matrixAutoUpdate = false;
    this.paddleWidth = half_width;
  }

  /** The matrix of item `i` of the list. */
  private read(drawn: Float32Array, i: number): Matrix4 {
    const n = drawn.subarray(kDrawnFloats * i + 4, kDrawnFloats * (i + 1));
    return this.matrix.set(n[0]!, n[3]!, n[6]!, n[9]!, n[1]!, n[4]!, n[7]!, n[10]!, n[2]!, n[5]!, n[8]!, n[11]!, 0, 0,
      0, 1);
  }

  /** Once a frame. `elapsed` s; `trails`: whether balls leave one. */
  update(game: Game, share: number, elapsed: number, trails: boolean): void {
    const drawn = game.drawn(share).slice();
    for (const { solid, signs } of this.kinds.values()) {
      for (const batch of [solid, ...Object.values(signs)]) batch.begin();
    }
    for (const batch of [this.ball, this.trail, this.egg, this.fuse]) batch.begin();
    const seen = new Set<number>();
    for (let i = 0; i < drawn.length / kDrawnFloats; ++i) {
      const [what, block, id, extra] = drawn.subarray(kDrawnFloats * i, kDrawnFloats * i + 4) as unknown as
        [number, number, number, number];
      const matrix = this.read(drawn, i);
      if (what === drawnWhat.block) this.addBlock(blockKinds[block]!, matrix, extra);
      else if (what === drawnWhat.paddle) this.placePaddle(game, matrix, extra, elapsed);
      else {
        this.ball.add(matrix, this.color.setHex(palette.ball));
        if (what === drawnWhat.ball) {
          seen.add(id);
          this.addTrail(id, matrix, elapsed > 0 && trails);
        }
      }
    }
    for (const id of this.trails.keys()) if (!seen.has(id)) this.trails.delete(id);
    for (const { solid, signs } of this.kinds.values()) {
      for (const batch of [solid, ...Object.values(signs)]) batch.end();
    }
    for (const batch of [this.ball, this.trail, this.egg, this.fuse]) batch.end();
  }

  private addBlock(kind: BlockKind, matrix: Matrix4, hits_left: number): void {
    const { solid, signs } = this.kinds.get(kind)!;
    const y = matrix.elements[13]!;
    const row = Math.max(0, Math.round((kTopRow - y) / kRowPitch));
    solid.add(matrix, kind === "plain" ? this.color.setHex(rowColors[row % rowColors.length]!)
      : this.color.setHex(0xffffff));
    const sign = kind === "tough" && hits_left < 2 ? signs.cracked : signs.whole;
    sign?.add(matrix);
    if (kind === "ball") this.egg.add(matrix);
    if (kind === "explosive") this.fuse.add(matrix);
  }

  /** The paddle grows with a spring, though the rules' does at once. */
  private placePaddle(game: Game, matrix: Matrix4, half_width: number, elapsed: number): void {
    if (half_width !== this.paddleWidth) {
      this.buildPaddle(game, half_width);
      if (this.shownWidth === 0) this.shownWidth = half_width;
    }
    this.shownWidth += (half_width - this.shownWidth) * Math.min(1, 12 * elapsed);
    this.paddle.matrix.copy(matrix);
    this.paddle.matrix.multiply(new Matrix4().makeScale(this.shownWidth / half_width, 1, 1));
    this.paddle.matrixWorldNeedsUpdate = true;
  }

  private addTrail(id: number, matrix: Matrix4, moves: boolean): void {
    const kLong = 9;
    const places = this.trails.get(id) ?? [];
    this.trails.set(id, places);
    if (moves) places.unshift(matrix.clone());
    places.length = Math.min(places.length, moves ? kLong : 0);
    places.forEach((place, i) => {
      const size = 1 - (i + 1) / (kLong + 1);
      const ghost = place.clone();
      ghost.elements[14] = -0.25;
      this.trail.add(ghost.multiply(new Matrix4().makeScale(size, size, size)));
    });
  }
}
