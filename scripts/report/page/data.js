// The numbers and pictures that the page carries as JSON.

function readJson(id) {
  return JSON.parse(document.getElementById(id).textContent);
}

/** The data of one scene. Pictures are many megabytes and only parsed when one is wanted. */
class SceneData {
  constructor(id) {
    Object.assign(this, readJson(`${id}-data`));
    this.id = id;
    this.uris = null;
  }

  /** The data URI by its index; null for none. */
  uri(index) {
    if (index === null || index === undefined) return null;
    this.uris = this.uris || readJson(`${this.id}-pictures`);
    return this.uris[index];
  }

  strategy(id) {
    return this.strategies.find((strategy) => strategy.id === id);
  }

  /** What texts call a strategy or the full-resolution model. */
  label(id) {
    if (id === "full") return "the full model";
    const strategy = this.strategy(id);
    return strategy ? strategy.label : id;
  }

  /** The counter's value in a frame, mean over repetitions; null for none. */
  value(counter, strategy, frame) {
    const values = this.series[counter][strategy];
    return frame < values.length ? values[frame] : null;
  }

  pictureFrames() {
    return this.pictures ? this.pictures.frames.map((entry) => entry.frame) : [];
  }

  pictureEntry(frame) {
    return this.pictures.frames.find((entry) => entry.frame === frame);
  }

  /** The frame with pictures that is nearest to a frame; the earlier of two. */
  nearestPictureFrame(frame) {
    return this.pictureFrames().reduce((best, candidate) =>
      Math.abs(candidate - frame) < Math.abs(best - frame) ? candidate : best);
  }
}
