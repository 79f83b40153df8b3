// Brings the page to life.

const scenes = [...document.querySelectorAll("section.scene")].map((section) => new Scene(section));
let active = scenes[0];
for (const section of document.querySelectorAll("section.sweep")) new Sweep(section);

for (const scene of scenes)
  for (const event of ["pointerdown", "focusin"])
    scene.section.addEventListener(event, () => {
      active = scene;
    });

/** Whether the element has a use of its own for the arrow keys. */
function usesArrows(element) {
  return element.matches("select, textarea, input:not([type=checkbox]), .scroll");
}

document.addEventListener("keydown", (event) => {
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (!step || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  if (usesArrows(event.target) || !active) return;
  event.preventDefault();
  active.step(step);
});

setUpPrinting(scenes);
setUpCopying(readJson("texts"));
setUpTheme(part(document, "theme"), () => scenes.forEach((scene) => scene.recolor()));
