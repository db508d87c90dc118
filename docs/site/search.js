// Finds pages by words of their names and summaries; `pages` comes from index.js.
const up = document.body.dataset.up;
const field = document.getElementById('search');
const list = document.getElementById('found');
const most = 30;

function matches(page, words) {
  const text = (page.title + ' ' + page.text).toLowerCase();
  return words.every((word) => text.includes(word));
}

function show() {
  const words = field.value.toLowerCase().split(/\s+/).filter(Boolean);
  list.replaceChildren();
  if (words.length === 0) return;
  const found = pages.filter((page) => matches(page, words)).slice(0, most);
  for (const page of found) {
    const link = document.createElement('a');
    link.href = up + page.target;
    link.textContent = page.title;
    link.title = page.text;
    list.append(link);
  }
  if (found.length === 0) list.textContent = 'Nothing found.';
}

field.addEventListener('input', show);
field.addEventListener('keydown', (event) => {
  if (event.key === 'Enter') list.querySelector('a')?.click();
});
