// Files that a visitor drops or chooses: scenes, takes, meshes.
import { limits } from "../core/limits.js";
import type { Studio } from "../studio.js";

export async function openFiles(studio: Studio, files: FileList | readonly File[]): Promise<void> {
  for (const file of Array.from(files)) await openFile(studio, file);
}

async function openFile(studio: Studio, file: File): Promise<void> {
  const ending = /\.(\w+)$/.exec(file.name)?.[1]?.toLowerCase() ?? "";
  if (ending === "json") {
    if (file.size > limits.text) {
      studio.tell(`${file.name} has ${file.size} bytes; the studio takes scenes of ${limits.text}.`, "error");
      return;
    }
    await studio.openText(await file.text(), file.name);
    return;
  }
  if (ending !== "glb" && ending !== "gltf" && ending !== "obj") {
    studio.tell(`${file.name}: the studio opens scenes and takes (.json) and meshes (.glb, .obj).`, "error");
    return;
  }
  if (file.size > limits.mesh) {
    studio.tell(`${file.name} has ${file.size} bytes; the studio takes meshes of ${limits.mesh}.`, "error");
    return;
  }
  studio.busy.value = `Reading ${file.name}`;
  try {
    const { readMesh } = await import("./mesh.js");
    const mesh = await readMesh(new Uint8Array(await file.arrayBuffer()), ending, file.name);
    studio.bringMesh(mesh.name, mesh.shape, mesh.object);
    studio.tell(mesh.note);
  } catch (error) {
    studio.tell(`${file.name}: ${(error as Error).message || "this file could not be read"}`, "error");
  } finally {
    studio.busy.value = "";
  }
}
