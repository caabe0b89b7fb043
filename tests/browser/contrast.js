(() => {
  const parts = c => (c.match(/[\d.]+/g) ?? []).map(Number);
  const light = ([r, g, b]) => {
    const f = v => (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4);
    return 0.2126 * f(r) + 0.7152 * f(g) + 0.0722 * f(b);
  };
  const below = el => {
    for (let e = el; e; e = e.parentElement) {
      const c = parts(getComputedStyle(e).backgroundColor);
      if (c.length === 3 || c[3] > 0.99) return c;
    }
    return [255, 255, 255];
  };
  const poor = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const el = walk.currentNode.parentElement;
    const text = walk.currentNode.textContent.trim();
    if (!text || ['SCRIPT', 'STYLE', 'NOSCRIPT'].includes(el.tagName) || !el.checkVisibility({ opacityProperty: true, visibilityProperty: true })) continue;
    // Pictures bring their own white.
    if (el.closest('.picture')) continue;
    const style = getComputedStyle(el);
    const ink = parts(el.closest('svg') ? style.fill : style.color);
    const [a, b] = [light(ink), light(below(el))].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < LEAST || (ink.length === 4 && ink[3] < 1)) poor.push(`${text.slice(0, 40)}: ${contrast.toFixed(2)} ${style.fill} ${style.color}`);
  }
  return poor;
})()
