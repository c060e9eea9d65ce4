// The gallery, and opening one's own files.
import { FolderOpen, History } from "lucide-preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { gallery, type GalleryScene } from "../core/gallery.js";
import { readTake } from "../core/take.js";
import { type Thumb, thumbOf } from "../core/thumb.js";
import type { Studio } from "../studio.js";
import { openFiles } from "../keep/open.js";
import { Section } from "./parts.js";
import { ThumbPicture } from "./thumb.js";

const thumbs = new Map<string, Thumb>();
let queue = Promise.resolve();

/** One after the other, with room for frames between. */
function thumbLater(scene: GalleryScene): Promise<Thumb> {
  const made = queue.then(async () => {
    await new Promise((resolve) => setTimeout(resolve, 30));
    const known = thumbs.get(scene.id);
    if (known !== undefined) return known;
    const take = readTake(scene.text());
    const thumb = thumbOf(take, {
      width: 160,
      height: 96,
      seconds: scene.group === "Many" ? 0.9 : 3.2,
      every: scene.group === "Many" ? 1 : 0.11,
    });
    thumbs.set(scene.id, thumb);
    return thumb;
  });
  queue = made.then(
    () => undefined,
    () => undefined,
  );
  return made;
}

function Card({ scene, current, onPick }: { scene: GalleryScene; current: boolean; onPick: () => void }) {
  const [thumb, setThumb] = useState<Thumb | null>(thumbs.get(scene.id) ?? null);
  useEffect(() => {
    let here = true;
    if (thumb === null)
      void thumbLater(scene).then(
        (made) => {
          if (here) setThumb(made);
        },
        () => undefined,
      );
    return () => {
      here = false;
    };
  }, []);
  return (
    <button type="button" class="card" aria-pressed={current} onClick={onPick}>
      <ThumbPicture thumb={thumb} width={160} height={96} />
      <span class="card-title">{scene.title}</span>
      <span class="card-note">{scene.note}</span>
    </button>
  );
}

export function ScenesPanel({ studio }: { studio: Studio }) {
  const input = useRef<HTMLInputElement>(null);
  const groups = [...new Set(gallery.map((scene) => scene.group))];
  return (
    <>
      <div class="target">
        <button type="button" class="button primary" onClick={() => input.current?.click()}>
          <FolderOpen size="1.1em" aria-hidden="true" /> Open a file
        </button>
        <input
          ref={input}
          type="file"
          hidden
          multiple
          accept=".json,.glb,.gltf,.obj"
          aria-label="Scene, take or mesh file"
          onChange={(event) => {
            void openFiles(studio, event.currentTarget.files ?? []);
            event.currentTarget.value = "";
          }}
        />
        {studio.hasLast.value ? (
          <button type="button" class="button" onClick={() => void studio.openLast()}>
            <History size="1.1em" aria-hidden="true" /> Last scene
          </button>
        ) : null}
        <p class="note">Scenes, takes (.json) and meshes (.glb, .obj). Drop them anywhere, too.</p>
      </div>
      {groups.map((group) => (
        <Section key={group} title={group}>
          <div class="cards">
            {gallery
              .filter((scene) => scene.group === group)
              .map((scene) => (
                <Card
                  key={scene.id}
                  scene={scene}
                  current={studio.sceneId.value === scene.id}
                  onPick={() => studio.openScene(scene.id)}
                />
              ))}
          </div>
        </Section>
      ))}
    </>
  );
}
