// Colours after Okabe and Ito, which colour-blind people tell apart; lighter ones on dark paper.

export interface Colours {
  circle: string; polygon: string; spring: string; wire: string; arrow: string;
  ink: string; text: string; paper: string; grid: string; accent: string; faint: string; series: string[];
}

const LIGHT: Colours = {
  circle: "#0072b2", polygon: "#d55e00", spring: "#009e73", wire: "#8c5a9e", arrow: "#b58900",
  ink: "#1f2328", text: "#1f2328", paper: "#ffffff", grid: "#eceef1", accent: "#0072b2", faint: "#6b7280",
  series: ["#0072b2", "#d55e00", "#009e73", "#8c5a9e", "#b58900", "#1f2328", "#56b4e9"],
};
const DARK: Colours = {
  circle: "#56b4e9", polygon: "#f0904a", spring: "#3ccfa0", wire: "#cc9ad8", arrow: "#f0c94a",
  ink: "#f2f2ee", text: "#f2f2ee", paper: "#16181c", grid: "#23262c", accent: "#56b4e9", faint: "#9aa1ab",
  series: ["#56b4e9", "#f0904a", "#3ccfa0", "#cc9ad8", "#f0c94a", "#f2f2ee", "#0072b2"],
};

const media = matchMedia("(prefers-color-scheme: dark)");
const listeners = new Set<() => void>();
let chosen = localStorage.getItem("inklined-theme");

export const dark = (): boolean => (chosen ? chosen === "dark" : media.matches);
export const colours = (): Colours => (dark() ? DARK : LIGHT);
export const still = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;

export function onTheme(listener: () => void): void { listeners.add(listener); }

export function toggleTheme(): void {
  chosen = dark() ? "light" : "dark";
  localStorage.setItem("inklined-theme", chosen);
  apply();
}

export function apply(): void {
  document.documentElement.dataset["theme"] = dark() ? "dark" : "light";
  for (const listener of listeners) listener();
}

media.addEventListener("change", apply);
