// Light or dark: the system's choice until the button makes another, which is remembered.

const THEME_KEY = "hlodbench-report-theme";
const systemDark = window.matchMedia("(prefers-color-scheme: dark)");
let isPrinting = false;

function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return !isPrinting && (chosen ? chosen === "dark" : systemDark.matches);
}

/** Some browsers refuse storage to files: the choice then lasts as long as the page. */
function remember(theme) {
  try {
    window.localStorage.setItem(THEME_KEY, theme);
  } catch (error) {
    // Nothing is lost but the memory.
  }
}

function recall() {
  try {
    return window.localStorage.getItem(THEME_KEY);
  } catch (error) {
    return null;
  }
}

/** Wires the button; calls onChange() whenever the colours change. */
function setUpTheme(button, onChange) {
  const saved = recall();
  if (saved === "dark" || saved === "light") document.documentElement.dataset.theme = saved;
  const update = () => {
    button.setAttribute("aria-pressed", String(isDark()));
    onChange();
  };
  button.addEventListener("click", () => {
    const theme = isDark() ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    remember(theme);
    update();
  });
  systemDark.addEventListener("change", update);
  update();
}
