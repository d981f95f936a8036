'use strict';
// Parts of every page: light and dark, the list of keys, commands to copy.
const page = {
  theme() { const root = document.documentElement; root.dataset.theme = getComputedStyle(root).colorScheme === 'dark' ? 'light' : 'dark'; },
  showKeys() { const keys = document.querySelector('#keys'); keys.open = true; keys.scrollIntoView({block: 'center'}); },
};
document.documentElement.classList.add('scripted');
document.querySelector('#theme').addEventListener('click', page.theme);
document.querySelector('#keys-button').addEventListener('click', page.showKeys);
document.querySelectorAll('.copy').forEach(button => button.addEventListener('click', async () => {
  const code = button.previousElementSibling;
  try { await navigator.clipboard.writeText(code.textContent); button.textContent = 'copied'; } catch { getSelection().selectAllChildren(code); button.textContent = 'selected'; }
  setTimeout(() => { button.textContent = 'copy'; }, 1500);
}));
