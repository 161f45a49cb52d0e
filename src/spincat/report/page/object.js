'use strict';
// The report of spincat info on an object.

const result = data.result;
const part = readPart('object-0');
const viewer = new Viewer('none');
const isMesh = result.kind === 'mesh';
const defectNames = { unfinite_points: (isMesh ? 'vertices' : 'points') + ' that are not finite, left out', repeated_points: 'repeated ' + (isMesh ? 'vertices' : 'points'), unused_vertices: 'vertices that no triangle uses',
  flat_triangles: 'triangles without area', repeated_triangles: 'repeated triangles', flipped_triangles: 'flipped triangles',
  dust_triangles: 'triangles far from the object, left out', lone_points: 'points far from all others, left out' };
const drawnDefects = Object.keys(part.defects).filter((key) => result.defects[key] > 0);
const layers = { surface: true, normals: false, spin: true };
for (const key of drawnDefects) layers[key] = true;

viewer.show = () => {
  if (!viewer.scene) return;
  viewer.clear();
  viewer.addShape(part.shape, drawnDefects.some((key) => layers[key]) || data.settings.surface === 'samples' ? 0.5 : 1);
  const surface = placesOf(part.surface.points);
  if (layers.surface) viewer.addDots(surface, null, 2.5, themeColour('--accent'));
  if (layers.normals) viewer.addNormals(surface, sharesOf(part.surface.normals), 0.06, themeColour('--accent'));
  if (layers.spin) viewer.addDots(placesOf(part.spin.points), null, 7, themeColour('--wrong'));
  drawnDefects.filter((key) => layers[key]).forEach((key) => viewer.addTriangles(placesOf(part.defects[key]), themeColour('--defect')));
  viewer.resize();
};

function choice(key, label) {
  const box = el('input', { type: 'checkbox', id: 'show-' + key, onchange: () => { layers[key] = box.checked; viewer.show(); } });
  box.checked = layers[key];
  return el('label', { class: 'layer' }, box, ' ', label);
}

const number = (value) => String(Number(value.toPrecision(6)));
const facts = [['kind', result.kind], [isMesh ? 'vertices' : 'points', String(result.points)],
  ...(isMesh ? [['triangles', String(result.triangles)]] : []),
  ['size', result.size.map(number).join(' × ')],
  ...(isMesh ? [['area', number(result.area)]] : []), ['resolution', number(result.resolution)]];
const defects = Object.entries(result.defects).filter(([key]) => isMesh ? key !== 'lone_points' : ['unfinite_points', 'repeated_points', 'lone_points'].includes(key));
const found = defects.filter(([, count]) => count > 0);

showPage(result.file,
  el('h1', {}, nameText(result.file)),
  el('section', { class: 'card' }, el('div', { class: 'beside' },
    el('div', {}, viewer.host, el('div', { class: 'layers no-print' },
      choice('surface', el('span', {}, countText(part.surface.count, 'surface point'))), choice('normals', 'their normals'),
      choice('spin', countText(part.spin.count, 'spin point')),
      ...drawnDefects.map((key) => choice(key, result.defects[key] + ' ' + defectNames[key])), ...viewer.upChoice())),
    el('div', { class: 'panel whole' }, el('h2', {}, 'Contents'), el('div', { id: 'facts' }, keyTable(facts)),
      el('h3', {}, 'Defects'),
      found.length ? null : el('p', { class: 'soft small' }, 'None found.'),
      el('div', { id: 'defects' }, el('table', { class: 'list keys' }, el('tbody', {}, ...defects.map(([key, count]) =>
        el('tr', { 'data-key': key }, el('td', { class: 'soft' }, defectNames[key]), el('td', { class: 'number' }, count)))))),
      isMesh ? el('p', { class: 'soft small' }, 'Flipped triangles look the other way than most of those that they share an edge with.') : null))),
  repeatCard(data.run, data.settings, [['file', result.file]]));
viewer.turnUpright(result.file);
viewer.show();
