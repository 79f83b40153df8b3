// Brings the page to life.

const shared = readJson("shared");
const machines = [...document.querySelectorAll("section.machine")].map(
  (section) => new TrendMachine(section, shared));
const choices = part(document, "choices");
let active = null;

/** The boxes of one kind. */
function boxes(name) {
  return [...choices.querySelectorAll(`input[name="${name}"]`)];
}

function showAll() {
  const [scene, counter] = ["scene", "counter"].map((name) => part(choices, name).value);
  const hidden = new Set(boxes("strategy").filter((box) => !box.checked).map((box) => box.value));
  const shown = boxes("machine").filter((box) => box.checked).map((box) => box.value);
  for (const machine of machines)
    machine.show(shown.includes(machine.section.id), scene, counter, new Set(hidden));
  active = machines.find((machine) => !machine.section.hidden) || null;
}

function recolorAll() {
  for (const swatch of choices.querySelectorAll("[data-swatch]"))
    paintSwatch(swatch, shared.strategies.find((s) => s.id === swatch.dataset.swatch));
  for (const machine of machines) machine.recolor();
}

for (const machine of machines)
  for (const event of ["pointerdown", "focusin"])
    machine.section.addEventListener(event, () => {
      active = machine;
    });

document.addEventListener("keydown", (event) => {
  const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (!step || event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
  if (event.target.matches("select, textarea, .scroll") || !active) return;
  event.preventDefault();
  active.step(step);
});

choices.addEventListener("change", showAll);
setUpPrinting(machines);
showAll();
setUpTheme(part(document, "theme"), recolorAll);
