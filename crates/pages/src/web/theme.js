'use strict';
// Colours come from the style sheet alone: a probe in the page says what a name means in the theme of the moment.
const root = document.documentElement;
const probe = document.body.appendChild(document.createElement('i'));
probe.hidden = true;

function colour(name) {
  probe.style.color = `var(--${name})`;
  return getComputedStyle(probe).color;
}

function faded(name, alpha) {
  const [r, g, b] = colour(name).match(/[\d.]+/g);
  return `rgba(${r},${g},${b},${alpha})`;
}

const systemDark = matchMedia('(prefers-color-scheme: dark)');
let chosen = null;

function isDark() {
  return chosen ? chosen === 'dark' : systemDark.matches;
}

function theme(name) {
  root.style.colorScheme = name ?? '';
  const button = document.getElementById('theme');
  button.textContent = isDark() ? 'Light' : 'Dark';
  button.setAttribute('aria-label', `Show in ${isDark() ? 'light' : 'dark'} colours`);
}
