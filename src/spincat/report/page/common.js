'use strict';
// What all reports have in common. Names come from other people's files: they only ever become text nodes.

const data = JSON.parse(document.getElementById('data').textContent);
const isText = (child) => typeof child === 'string' || typeof child === 'number';

// An element with properties ({class, title, onclick, data-..., style: {name: value}}) and children (elements or texts).
function el(tag, properties, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties || {})) {
    if (name === 'style') {
      for (const [key, setting] of Object.entries(value)) element.style.setProperty(key, setting);
    } else if (typeof value === 'function') {
      element[name] = value;
    } else if (value !== undefined) {
      element.setAttribute(name, value);
    }
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

// A name from outside: its own direction, so that right-to-left letters do not reorder what stands beside it.
function nameText(text) { return el('bdi', {}, String(text)); }

function card(title, note, ...children) {
  return el('section', { class: 'card' }, el('h2', {}, title), note ? el('p', { class: 'soft small' }, note) : null, ...children);
}

const rateText = (rate) => rate.toFixed(3);
const shareText = (share) => (100 * share).toFixed(share > 0 && share < 0.1 ? 1 : 0) + ' %';
const spanText = (interval) => rateText(interval[0]) + ' to ' + rateText(interval[1]);
const countText = (count, one, many) => count + ' ' + (count === 1 ? one : many || one + 's');

// As the command prints times: "1.3 ms", "12.4 s", "3 min 20 s".
function secondsText(seconds) {
  if (seconds < 0.9995) return (1e3 * seconds).toFixed(seconds < 0.0995 ? 1 : 0) + ' ms';
  if (seconds < 59.95) return seconds.toFixed(1) + ' s';
  const whole = Math.round(seconds);
  return whole < 3600 ? Math.floor(whole / 60) + ' min ' + whole % 60 + ' s'
    : Math.floor(whole / 3600) + ' h ' + Math.floor(whole % 3600 / 60) + ' min';
}

// Number text short enough for an axis or a table.
const shortNumber = (value) => Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(4)));

// Where all files lie, so that only what differs has to be shown.
function commonFolder(files) {
  if (files.length === 0) return '';
  let folder = files[0].slice(0, files[0].lastIndexOf('/') + 1);
  for (const file of files) {
    while (!file.startsWith(folder)) folder = folder.slice(0, folder.lastIndexOf('/', folder.length - 2) + 1);
  }
  return folder;
}

// A table whose rows are built a page at a time: `row(item)` gives the cells of one.
function pagedTable(heads, items, row, pageSize = 50) {
  const body = el('tbody');
  let shown = 0;
  const more = el('button', { type: 'button', class: 'no-print', onclick: () => grow() }, '');
  function grow() {
    for (const item of items.slice(shown, shown + pageSize)) {
      const cells = row(item);
      body.append(el('tr', {}, ...cells.map((cell, i) => el('td', { class: heads[i][1] }, cell))));
    }
    shown = Math.min(shown + pageSize, items.length);
    more.textContent = 'Show ' + Math.min(pageSize, items.length - shown) + ' more of ' + items.length;
    more.hidden = shown >= items.length;
  }
  grow();
  window.addEventListener('beforeprint', () => { while (shown < items.length) grow(); });
  const table = el('table', { class: 'list' }, el('thead', {}, el('tr', {}, ...heads.map((head) => el('th', { class: head[1] }, head[0])))), body);
  return el('div', {}, el('div', { class: 'scroll' }, table), more);
}

// Settings and the like: nested objects become "spin.bin_size".
function flattened(object, prefix = '') {
  const rows = [];
  for (const [key, value] of Object.entries(object)) {
    if (value !== null && typeof value === 'object' && !Array.isArray(value)) {
      rows.push(...flattened(value, prefix + key + '.'));
    } else {
      rows.push([prefix + key, typeof value === 'string' ? value : JSON.stringify(value)]);
    }
  }
  return rows;
}

function keyTable(rows) {
  return el('table', { class: 'list keys' }, el('tbody', {}, ...rows.map(([key, value]) =>
    el('tr', { 'data-key': key }, el('td', { class: 'soft' }, key), el('td', { class: 'name' }, nameText(value))))));
}

// A word of a command line as a shell takes it.
const shellWord = (word) => /^[A-Za-z0-9_@%+=:,./-]+$/.test(word) ? word : "'" + word.replaceAll("'", "'\\''") + "'";

// How to repeat the run, and with which settings.
function repeatCard(run, settings, facts) {
  const rows = Object.entries(run).filter(([key]) => key !== 'command')
    .map(([key, value]) => [key, typeof value === 'string' ? value : JSON.stringify(value)]);
  return card('Reproduce this page', null,
    el('pre', { id: 'command' }, nameText(run.command.map(shellWord).join(' '))),
    el('div', { class: 'columns' },
      el('div', {}, el('h3', {}, 'Run'), keyTable([...facts, ...rows])),
      el('details', { open: '' }, el('summary', { class: 'small' }, 'Settings'), keyTable(flattened(settings)))));
}

const stageNames = ['read', 'prepare', 'spin', 'encode', 'judge'];

// Time by stage as one bar and a table (the paper's Figure 3).
function stageBar(seconds) {
  const total = stageNames.reduce((sum, stage) => sum + seconds[stage], 0) || 1;
  const colour = (i) => 'var(--stage-' + i + ')';
  return el('div', {},
    el('div', { class: 'stages', role: 'img', 'aria-label': 'time by stage' }, ...stageNames.map((stage, i) =>
      el('div', { title: stage + ' ' + secondsText(seconds[stage]), style: { width: 100 * seconds[stage] / total + '%', background: colour(i) } }))),
    el('table', { class: 'list stage-times' }, el('tbody', {}, ...stageNames.map((stage, i) => el('tr', { 'data-stage': stage },
      el('td', {}, el('span', { class: 'key', style: { background: colour(i) } }), stage),
      el('td', { class: 'number' }, secondsText(seconds[stage])), el('td', { class: 'number' }, shareText(seconds[stage] / total)))))));
}

function isDark() {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

// The theme follows the system until somebody chooses; pictures are told by the event "theme".
function installTheme() {
  const button = document.getElementById('theme');
  const label = () => { button.textContent = isDark() ? 'Light' : 'Dark'; };
  button.setAttribute('aria-label', 'switch between light and dark');
  button.onclick = () => {
    document.documentElement.dataset.theme = isDark() ? 'light' : 'dark';
    label();
    document.dispatchEvent(new Event('theme'));
  };
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { label(); document.dispatchEvent(new Event('theme')); });
  label();
}

function showPage(title, ...children) {
  document.title = title + ' - spincat';
  document.getElementById('main').replaceChildren(...children);
  installTheme();
}
