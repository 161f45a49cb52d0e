'use strict';
// The report of spincat classify.

const objects = data.objects;
const categories = data.model.categories;
const folder = commonFolder(objects.map((each) => each.result.file));
const shortName = (object) => object.result.file.slice(folder.length);
const viewer = new Viewer(data.model.settings.up);
const named = el('div', { id: 'named' });
const evidence = el('div', { id: 'evidence' });
const judges = el('div', { id: 'judges' });
const place = el('span', { class: 'soft', id: 'place' });
const kMostRows = 16;  // of the judges' matrix, until all are asked for
const surfaceTexts = { external: 'points on the outside', samples: 'points on all faces', vertices: 'vertices' };
const axesTexts = { normals: '', radial: ', axes away from the middle' };
let current = 0;
let partShown = 0;
let allRows = false;
window.addEventListener('beforeprint', () => { if (!allRows) { allRows = true; showObject(current); } });

function evidenceText(kind, part) {
  if (kind === 'shares') return 'Exact: each spin point’s share of this margin. The shares of all points, with equal parts of the judge’s bias, add up to it.';
  const every = part.parts.every((points) => shortsOf(points.values).length >= points.spin_points);
  return 'By leaving out: how much this margin falls without the spin point, all others kept. These need not add up to it.' +
    (every ? '' : ' Only the coloured ones were left out, one after the other.');
}

// Colours from the runner-up's over the surface's to the winner's.
function coloursOf(values) {
  const [against, middle, speaking] = ['--wrong', '--surface', '--right'].map(themeColour);
  const colours = new Float32Array(3 * values.length);
  values.forEach((value, i) => middle.clone().lerp(value > 0 ? speaking : against, Math.sqrt(Math.abs(value))).toArray(colours, 3 * i));
  return colours;
}

viewer.show = () => {
  if (!viewer.scene || !objects[current].part) return;
  const part = readPart(objects[current].part);
  const all = part.evidence.parts;
  const points = all[partShown];
  const strongest = Math.max(...all.map((each) => each.strongest)) || 1;
  const values = sharesOf(points.values).map((value) => value * points.strongest / strongest);
  viewer.clear();
  viewer.addShape(part.shape, part.shape.triangles && points.surface === 'samples' ? 0.35 : 1);  // some of those points are inside
  viewer.addDots(placesOf(points.points), coloursOf(values), 8);
  viewer.resize();
};

// One spin image, its channels side by side; dark is full.
function spinPicture(image) {
  const { rows, columns, channels } = image;
  const values = bytesOf(image.values);
  const canvas = el('canvas', { width: columns * channels, height: rows });
  const pen = canvas.getContext('2d');
  const picture = pen.createImageData(columns * channels, rows);
  for (let channel = 0; channel < channels; ++channel) {
    for (let i = 0; i < rows * columns; ++i) {
      const at = 4 * (Math.floor(i / columns) * columns * channels + channel * columns + i % columns);
      picture.data.fill(values[channel * rows * columns + i], at, at + 3);
      picture.data[at + 3] = 255;
    }
  }
  pen.putImageData(picture, 0, 0);
  return canvas;
}

function markPoint(image) {
  if (!viewer.scene) return;
  if (partShown !== image.part) {
    partShown = image.part;
    const choice = document.getElementById('part');
    if (choice) choice.value = String(partShown);
  }
  viewer.show();
  const places = placesOf(readPart(objects[current].part).evidence.parts[image.part].points);
  const mark = viewer.addDots(places.slice(3 * image.point, 3 * image.point + 3), null, 16, themeColour('--ink'));
  mark.material.depthTest = false;  // seen through the object
  mark.renderOrder = 1;
  viewer.draw();
}

function strongestPoints(images, winner, runnerUp) {
  const show = (image) => el('figure', {}, el('button', { type: 'button', title: 'show this point', onclick: () => markPoint(image) }, spinPicture(image),
    el('figcaption', { class: 'small' }, (image.value > 0 ? '+' : '') + image.value.toPrecision(2))));
  const pictures = (name, chosen) => chosen.length ? [el('h3', {}, 'Spin images that speak most for ', nameText(name)), el('div', { class: 'pictures' }, ...chosen.map(show))] : [];
  return [...pictures(winner, images.filter((image) => image.value > 0)), ...pictures(runnerUp, images.filter((image) => image.value < 0))];
}

function partLabel(points, number, all) {
  const draws = all.filter((each) => each.surface === points.surface && each.axes === points.axes).length;
  return (surfaceTexts[points.surface] || points.surface) + (axesTexts[points.axes] ?? ', axes along ' + points.axes) +
    (draws > 1 ? ', draw ' + (number % draws + 1) : '') + ' (' + points.spin_points + ')';
}

function showEvidence(part) {
  const found = part.evidence;
  const [winner, runnerUp] = [categories[found.winner], categories[found.runner_up]];
  const choice = el('select', { id: 'part', 'aria-label': 'which spin points', onchange: () => { partShown = Number(choice.value); viewer.show(); } },
    ...found.parts.map((points, p) => el('option', { value: p }, partLabel(points, p, found.parts))));
  evidence.replaceChildren(
    el('h3', {}, 'Where the evidence lies'),
    el('p', { class: 'small' }, nameText(runnerUp), el('span', { class: 'scale' }), nameText(winner)),
    el('p', { class: 'small' }, 'The judge of these two says ', el('b', { id: 'margin', 'data-margin': found.margin }, Math.abs(found.margin).toFixed(3)), ' for ',
      nameText(found.margin >= 0 ? winner : runnerUp), found.margin >= 0 ? '. ' : ', which fewer of the others speak for. ',
      el('span', { class: 'soft', id: 'evidence-kind' }, evidenceText(found.kind, found))),
    found.parts.length > 1 ? el('p', { class: 'small no-print' }, 'Spin points: ', choice) : '',
    found.images.length ? '' : el('p', { class: 'soft small' }, 'No spin point speaks for either of them.'), ...strongestPoints(found.images, winner, runnerUp));
}

// Every judge's margin: the row's category against the column's.
function judgesTable(result, part) {
  const { unit } = part.margins;
  const decimals = Math.max(0, Math.round(-Math.log10(unit)));
  const margins = categories.map(() => []);
  let strongest = 0;
  const shorts = shortsOf(part.margins.values);
  for (let a = 0, l = 0; a < categories.length; ++a) {
    for (let b = a + 1; b < categories.length; ++b, ++l) {
      margins[a][b] = shorts[l] * unit;
      margins[b][a] = -margins[a][b];
      strongest = Math.max(strongest, Math.abs(margins[a][b]));
    }
  }
  const votes = categories.map((name) => result.votes[name]);
  const ranked = [part.evidence.winner, part.evidence.runner_up];
  const rank = (c) => ranked.includes(c) ? ranked.indexOf(c) : ranked.length;
  const order = categories.map((_, c) => c).sort((a, b) => rank(a) - rank(b) || votes[b] - votes[a] || a - b);
  const shown = allRows ? order : order.slice(0, kMostRows);
  const many = shown.length > 20;
  const note = el('p', { class: 'small', id: 'judge', 'aria-live': 'polite' }, 'Choose a cell to see what its judge says.');
  const tell = (a, b) => {
    const value = margins[a][b];
    const said = value === 0 ? [' for either of them (its vote went by the digits after those).'] : [' for ', nameText(categories[value > 0 ? a : b]), '.'];
    note.replaceChildren('Between ', nameText(categories[a]), ' and ', nameText(categories[b]), ' the judge says ',
      el('b', { class: 'margin' }, Math.abs(value).toFixed(decimals)), ...said);
  };
  const cell = (a, b) => a === b ? el('td') : el('td', { class: (margins[a][b] > 0 ? 'right' : 'wrong') + (Math.abs(margins[a][b]) > 0.6 * strongest ? ' strong' : ''),
    'data-a': a, 'data-b': b, style: { '--share': (0.1 + 0.9 * Math.abs(margins[a][b]) / (strongest || 1)).toFixed(3) } },
  el('button', { type: 'button', onclick: () => tell(a, b) }, margins[a][b].toFixed(many ? 1 : 2)));
  const table = el('table', { class: 'matrix' + (many ? ' many' : '') },
    el('thead', {}, el('tr', {}, el('th', { class: 'side' }), el('th', { class: 'above' }, el('span', {}, 'votes')), ...shown.map((c) => el('th', { class: 'above', title: categories[c] }, el('span', {}, nameText(categories[c])))))),
    el('tbody', {}, ...shown.map((a) => el('tr', {}, el('th', { class: 'side', title: categories[a] }, nameText(categories[a])), el('td', { class: 'votes', 'data-votes': a }, votes[a]),
      ...shown.map((b) => cell(a, b))))));
  const more = el('button', { type: 'button', class: 'no-print', id: 'all-judges', onclick: () => { allRows = !allRows; judges.replaceChildren(...judgesTable(result, part)); } },
    allRows ? 'Fewer' : 'All ' + categories.length + ' categories');
  return [el('div', { class: 'scroll' + (many ? ' tall' : '') }, table), note, ...(categories.length > kMostRows ? [more] : [])];
}

function nameLines(object) {
  const { result } = object;
  if (result.error) return [el('h2', {}, nameText(shortName(object))), el('p', { id: 'error' }, nameText(result.error))];
  const guess = result.best_guess || result.category;
  return [el('p', { class: 'soft' }, nameText(shortName(object)), ' is named'), el('div', { class: 'big', id: 'name' }, nameText(result.category)),
    result.best_guess ? el('p', {}, 'most like ', nameText(result.best_guess), ', but hardly of any category') : '',
    el('p', {}, 'confidence ', el('b', { id: 'confidence' }, result.confidence.toFixed(2)), ', known ', el('b', {}, result.known.toFixed(2)), ', ',
      el('b', { id: 'votes' }, result.votes[guess] + ' of ' + (categories.length - 1)), ' votes, ', secondsText(result.milliseconds / 1e3)),
    result.kind_mismatch ? el('p', { id: 'kind-mismatch' }, 'This ', nameText(result.kind_mismatch), '.') : ''];
}

function showObject(i) {
  current = i;
  partShown = 0;
  const { result, part } = objects[i];
  for (const button of document.querySelectorAll('#objects .choice')) button.setAttribute('aria-pressed', String(Number(button.dataset.object) === i));
  place.textContent = (i + 1) + ' of ' + objects.length;
  named.replaceChildren(...nameLines(objects[i]));
  if (part) {
    viewer.turnUpright(result.file);
    showEvidence(readPart(part));
    judges.replaceChildren(...judgesTable(result, readPart(part)));
    viewer.show();
  } else {
    evidence.replaceChildren();
    judges.replaceChildren(el('p', { class: 'soft' }, 'Nothing was said on this object.'));
    if (viewer.scene) { viewer.clear(); viewer.draw(); }
  }
}

function objectsCard() {
  const place = el('div', { id: 'objects', class: 'choices' });
  const fill = (wanted) => {
    const found = objects.map((_, i) => i).filter((i) => (shortName(objects[i]) + '\n' + (objects[i].result.category || '')).toLowerCase().includes(wanted.toLowerCase()));
    place.replaceChildren(pagedTable([['object', 'name'], ['named', 'name'], ['confidence', 'number']], found, (i) => [
      el('button', { type: 'button', class: 'choice', 'data-object': i, 'aria-pressed': String(i === current), onclick: () => showObject(i) }, nameText(shortName(objects[i]))),
      nameText(objects[i].result.error ? 'not named' : objects[i].result.category), objects[i].result.error ? '' : objects[i].result.confidence.toFixed(2)]));
  };
  fill('');
  const search = el('input', { type: 'search', class: 'no-print', placeholder: 'Find an object or category', 'aria-label': 'Find an object or category', oninput: () => fill(search.value) });
  return card('Objects', null, search, place);
}

const step = (by, label) => el('button', { type: 'button', 'aria-label': by < 0 ? 'the object before' : 'the next object', onclick: () => showObject((current + by + objects.length) % objects.length) }, label);
showPage('Names of ' + countText(objects.length, 'object'),
  el('h1', {}, objects.length === 1 ? nameText(shortName(objects[0])) : countText(objects.length, 'object'), ' classified'),
  el('p', { class: 'soft' }, 'Named by ', nameText(data.model.file), ', which learned ', countText(categories.length, 'category', 'categories'), ' from ', nameText(data.model.dataset), '.'),
  ...(objects.length > 1 ? [objectsCard()] : []),
  el('section', { class: 'card' },
    objects.length > 1 ? el('div', { class: 'row no-print' }, step(-1, '←'), place, step(1, '→')) : '',
    el('div', { class: 'beside' }, el('div', {}, viewer.host, el('div', { class: 'layers no-print' }, ...viewer.upChoice())), el('div', { class: 'panel whole' }, named, evidence))),
  card('What every judge said', 'The margin of the judge of each pair: blue speaks for the row’s category, orange for the column’s. Most votes win.', judges),
  repeatCard(data.run, data.model.settings, [['model', data.model.file]]));
if (objects.length > 0) showObject(0);
