'use strict';
document.addEventListener('keydown', event => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const act = {t: page.theme, '?': page.showKeys}[event.key];
  if (act) act();
});
document.documentElement.dataset.ready = '1';
