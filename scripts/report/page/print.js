// On paper the page is light, and plots are as wide as both A4 and Letter have room for.

const PAPER_WIDTH = 680; // CSS pixels

function setUpPrinting(scenes) {
  for (const [event, value] of [["beforeprint", true], ["afterprint", false]])
    window.addEventListener(event, () => {
      isPrinting = value;
      for (const scene of scenes) {
        scene.recolor();
        if (scene.plots) scene.plots.scaleTo(isPrinting ? PAPER_WIDTH : null);
      }
    });
}
