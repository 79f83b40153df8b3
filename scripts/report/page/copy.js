// Copies the table in one of the formats that the program prints.

/** Resolves to whether the text is in the clipboard. */
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch (error) {
    return copyBySelection(text); // the clipboard API may be denied to files
  }
}

function copyBySelection(text) {
  const area = make("textarea", { readonly: "", "aria-hidden": "true" });
  area.value = text;
  area.style.position = "fixed";
  area.style.opacity = "0";
  document.body.append(area);
  const focused = document.activeElement;
  area.select();
  let done = false;
  try {
    done = document.execCommand("copy");
  } catch (error) {
    done = false;
  }
  area.remove();
  if (focused) focused.focus();
  return done;
}

/** Shows the text, selected, to be copied by hand. */
function offerText(place, text) {
  const old = document.querySelector(".by-hand");
  if (old) old.remove();
  const area = make("textarea", { readonly: "", class: "by-hand", "aria-label": "Table as text" });
  area.value = text;
  place.after(area);
  area.focus();
  area.select();
}

function setUpCopying(texts) {
  const status = part(document, "copied");
  for (const button of document.querySelectorAll("[data-copy]"))
    button.addEventListener("click", async () => {
      const text = texts[button.dataset.copy];
      if (await copyText(text)) {
        status.textContent = `Copied ${text.length} characters.`;
      } else {
        status.textContent = "The browser refused: copy the selected text.";
        offerText(button.parentElement, text);
      }
    });
}
