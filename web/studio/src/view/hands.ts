// Mouse, pen and finger on the picture: throwing, selecting, and the gizmo that moves and turns things.
import { Object3D, Plane, Quaternion, Raycaster, Vector3 } from "three";
import type { Triple } from "../core/take.js";
import type { Studio } from "../studio.js";

const round = (value: number): number => Number(value.toFixed(4)) + 0;
const tripleOf = ({ x, y, z }: Vector3): Triple => [round(x), round(y), round(z)];

export function useHands(studio: Studio): void {
  const { director } = studio;
  const { canvas, controls, gizmo, thrower } = director;
  let pressed: { id: number; x: number; y: number; playing: boolean } | null = null;

  /** The body that is seen there: not behind a solid. */
  const bodyAt = (ray: Raycaster): string | null => {
    const view = director.views[director.pane];
    if (view === undefined) return null;
    const index = view.pickBody(ray);
    return view.player.bodies.find((played) => played.body.index === index)?.name ?? null;
  };
  const grabAt = (x: number, y: number): string | null => {
    const exact = bodyAt(director.rayAt(x, y));
    if (exact !== null) return exact;
    // A finger is broad: around the place too.
    for (const [dx, dy] of [
      [14, 0],
      [-14, 0],
      [0, 14],
      [0, -14],
    ] as const) {
      const near = bodyAt(director.rayAt(x + dx, y + dy));
      if (near !== null) return near;
    }
    return null;
  };

  canvas.addEventListener(
    "pointerdown",
    (event) => {
      if (!event.isPrimary || event.button !== 0 || gizmo.dragging || gizmo.axis !== null) return;
      const name = grabAt(event.clientX, event.clientY);
      if (studio.tool.value === "edit") {
        if (name !== null) studio.selectBody(name);
        else {
          const found = director.views[0]?.obstacles.pick(director.rayAt(event.clientX, event.clientY), false);
          if (found !== undefined && found.index >= 0) studio.selectObstacle(found.index);
        }
        return;
      }
      const player = studio.players.value[director.pane];
      const played = player?.bodyNamed(name);
      if (player === undefined || played === undefined || name === null) return;
      event.preventDefault();
      controls.enabled = false;
      canvas.setPointerCapture(event.pointerId);
      pressed = { id: event.pointerId, x: event.clientX, y: event.clientY, playing: studio.playing.value };
      studio.scrub(studio.step / 60);
      player.goTo(studio.step);
      studio.selectBody(name);
      thrower.begin(player, played, director.stage.camera);
      canvas.style.cursor = "grabbing";
    },
    { capture: true },
  );

  canvas.addEventListener("pointermove", (event) => {
    if (pressed === null) {
      if (event.pointerType === "mouse" && event.buttons === 0 && studio.tool.value === "throw") {
        canvas.style.cursor = bodyAt(director.rayAt(event.clientX, event.clientY)) === null ? "" : "grab";
      }
      return;
    }
    if (event.pointerId !== pressed.id) return;
    thrower.pull(director.rayAt(event.clientX, event.clientY));
    studio.aiming.value = thrower.speed > 0 ? { speed: thrower.speed } : null;
    director.invalidate();
  });

  const end = (event: PointerEvent, cancelled: boolean) => {
    if (pressed === null || event.pointerId !== pressed.id) return;
    const { playing } = pressed;
    pressed = null;
    controls.enabled = true;
    canvas.style.cursor = "";
    studio.aiming.value = null;
    const aim = cancelled ? (thrower.cancel(), null) : thrower.release();
    director.invalidate();
    if (aim === null) studio.setPlaying(playing);
    else studio.throwNow(aim.name, aim.position, aim.velocity.map(round) as unknown as Triple);
  };
  canvas.addEventListener("pointerup", (event) => end(event, false));
  canvas.addEventListener("pointercancel", (event) => end(event, true));
  addEventListener(
    "keydown",
    (event) => {
      if (event.key !== "Escape" || pressed === null) return;
      const { playing } = pressed;
      pressed = null;
      thrower.cancel();
      controls.enabled = true;
      studio.aiming.value = null;
      studio.setPlaying(playing);
      event.stopImmediatePropagation();
    },
    { capture: true },
  );
  useGizmo(studio);
}

function useGizmo(studio: Studio): void {
  const { director } = studio;
  const { gizmo } = director;
  const proxy = new Object3D();
  director.stage.scene.add(proxy);
  let good: { position: Vector3; quaternion: Quaternion } | null = null;

  const attach = () => {
    const { selection, tool, players } = studio;
    const player = players.value[0];
    const chosen = selection.value;
    if (tool.value !== "edit" || chosen === null || player === undefined) {
      gizmo.detach();
      return;
    }
    if (gizmo.dragging) return;
    if (chosen.kind === "body") {
      const played = player.bodyNamed(chosen.name);
      if (played === undefined) {
        gizmo.detach();
        return;
      }
      const { position } = player.motionOf(played.body, [director.show.time]).poses[0]!;
      proxy.position.set(position.x, position.y, position.z);
      proxy.quaternion.identity();
    } else {
      const frame = player.scene.obstacleFrame(chosen.index, 0);
      proxy.position.set(frame.position.x, frame.position.y, frame.position.z);
      proxy.quaternion.set(frame.rotation.x, frame.rotation.y, frame.rotation.z, frame.rotation.w);
    }
    gizmo.setMode(chosen.kind === "body" ? "translate" : studio.gizmoMode.value);
    proxy.updateMatrixWorld();
    gizmo.attach(proxy);
  };
  studio.onSelection = attach;
  studio.gizmoMode.subscribe(attach);

  gizmo.addEventListener("mouseDown", () => {
    studio.setPlaying(false);
    attach();
    good = { position: proxy.position.clone(), quaternion: proxy.quaternion.clone() };
  });
  gizmo.addEventListener("objectChange", () => {
    const selection = studio.selection.value;
    if (selection === null || !gizmo.dragging) return;
    const position = tripleOf(proxy.position);
    const { x, y, z, w } = proxy.quaternion;
    let done: boolean;
    if (selection.kind === "body") done = studio.moveBody(selection.name, position, "gizmo");
    else {
      const obstacle = studio.take.value.scene.obstacles?.[selection.index];
      if (obstacle?.shape === undefined) done = movePlane(studio, selection.index, proxy);
      else
        done = studio.changeObstacle(
          selection.index,
          { position, rotation: [round(x), round(y), round(z), round(w)] },
          "gizmo",
        );
    }
    if (done) good = { position: proxy.position.clone(), quaternion: proxy.quaternion.clone() };
    else if (good !== null) {
      proxy.position.copy(good.position);
      proxy.quaternion.copy(good.quaternion);
    }
  });
  gizmo.addEventListener("mouseUp", () => {
    studio.settle();
    attach();
  });
  studio.time.subscribe(() => {
    if (gizmo.object !== undefined && studio.selection.value?.kind === "body") attach();
  });
}

/** A plane knows its normal and its distance from the origin. */
function movePlane(studio: Studio, index: number, proxy: Object3D): boolean {
  const normal = studio.take.value.scene.obstacles?.[index]?.normal ?? [0, 1, 0];
  const turned = new Vector3(...normal).normalize().applyQuaternion(proxy.quaternion);
  const plane = new Plane().setFromNormalAndCoplanarPoint(turned, proxy.position);
  // The turn is in the normal from now on.
  proxy.quaternion.identity();
  return studio.changeObstacle(index, { normal: tripleOf(turned), offset: round(-plane.constant) }, "gizmo");
}
