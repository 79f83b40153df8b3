// Two pictures, one over the other, with an edge that is dragged or moved by the slider.

class Comparison {
  constructor(root) {
    this.stack = part(root, "stack");
    this.left = part(root, "left");
    this.right = part(root, "right");
    this.edge = part(root, "edge");
    this.slider = part(root, "slider");
    this.slider.addEventListener("input", () => this.place(Number(this.slider.value)));
    this.stack.addEventListener("pointerdown", (event) => this.drag(event));
    this.stack.addEventListener("pointermove", (event) => {
      if (event.buttons) this.drag(event);
    });
    this.place(50);
  }

  drag(event) {
    const box = this.stack.getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
    if (event.type === "pointerdown") this.stack.setPointerCapture(event.pointerId);
    this.slider.value = String(Math.round(100 * share));
    this.place(100 * share);
  }

  /** Left of `percent` the left picture is seen. */
  place(percent) {
    this.right.style.clipPath = `inset(0 0 0 ${percent}%)`;
    this.edge.style.left = `${percent}%`;
  }

  /** Shows both pictures; with only one of them there is nothing to slide. */
  show(left, leftText, right, rightText) {
    setPicture(this.left, left || right, left ? leftText : rightText);
    setPicture(this.right, left && right, rightText);
    const isPair = Boolean(left && right);
    this.edge.hidden = !isPair;
    this.slider.disabled = !isPair;
    this.stack.hidden = !left && !right;
  }
}

/** Puts the rectangle over a window [left, top, width, height] of a picture; null hides it. */
function placeRegion(rectangle, region, width, height) {
  rectangle.hidden = !region;
  if (!region) return;
  const percents = { left: region[0] / width, top: region[1] / height,
                     width: region[2] / width, height: region[3] / height };
  for (const [side, share] of Object.entries(percents)) rectangle.style[side] = `${100 * share}%`;
}
