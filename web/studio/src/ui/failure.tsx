// A page that cannot go on: what is the matter, and what can be done.
import { TriangleAlert } from "lucide-preact";

export function Failure({ title, text }: { title: string; text: string }) {
  return (
    <main class="failure" role="alert">
      <TriangleAlert aria-hidden="true" />
      <h1>{title}</h1>
      <p>{text}</p>
      <button class="button primary" type="button" onClick={() => location.reload()}>
        Try again
      </button>
    </main>
  );
}
