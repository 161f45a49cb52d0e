'use strict';
// The report of spincat sweep: one setting gives curves, two a heat map.

const result = data.result;
const settings = Object.keys(result.vary);
const svgElement = (tag, attributes, ...children) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};
const totalSeconds = (point) => stageNames.reduce((sum, stage) => sum + point.stage_seconds[stage], 0);

// Round numbers from 0 or near `low` to `high`.
function ticksOf(low, high) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 3 || 1));
  const wide = [1, 2, 5, 10].find((factor) => (high - low) / (factor * step) <= 6) * step;
  const ticks = [];
  for (let tick = Math.ceil(low / wide - 1e-9) * wide; tick <= high + 1e-9 * wide; tick += wide) ticks.push(Number(tick.toPrecision(12)));
  return ticks;
}

// Where each value stands: numbers by their size (by their logarithm when they span more than a factor of 8), words evenly.
function placesAlong(values) {
  const numbers = values.map(Number);
  if (numbers.some((number) => !Number.isFinite(number)) || new Set(numbers).size < 2) return values.map((_, i) => (i + 0.5) / values.length);
  const low = Math.min(...numbers);
  const high = Math.max(...numbers);
  const scale = low > 0 && high / low > 8 ? Math.log : (x) => x;
  return numbers.map((number) => 0.04 + 0.92 * (scale(number) - scale(low)) / (scale(high) - scale(low)));
}

// One curve with its spread: points are {y, low, high} with a label for each in `values`.
function lineChart(values, series, unit, range) {
  const [width, height, left, top, bottom] = [560, 260, 58, 10, 40];
  const all = series.flatMap((each) => each.points.flatMap((point) => [point.low, point.high]));
  const low = range ? Math.max(range[0], Math.min(...all) - 0.05) : 0;
  const high = range ? Math.min(range[1], Math.max(...all) + 0.03) : Math.max(...all) * 1.06 || 1;
  const x = placesAlong(values).map((place) => left + place * (width - left - 12));
  const y = (value) => top + (height - top - bottom) * (1 - (value - low) / (high - low));
  const chart = svgElement('svg', { class: 'chart', viewBox: '0 0 ' + width + ' ' + height, role: 'img', 'aria-label': series.map((each) => each.name).join(', ') });
  for (const tick of ticksOf(low, high)) {
    chart.append(svgElement('line', { class: 'grid', x1: left, x2: width - 8, y1: y(tick), y2: y(tick) }),
      svgElement('text', { x: left - 8, y: y(tick) + 4, 'text-anchor': 'end' }, unit ? unit(tick) : shortNumber(tick)));
  }
  let last = -Infinity;
  values.forEach((value, i) => {
    if (x[i] - last < 26) return;  // labels must not run into each other
    last = x[i];
    chart.append(svgElement('text', { x: x[i], y: height - 20, 'text-anchor': 'middle' }, value));
  });
  chart.append(svgElement('text', { x: (left + width) / 2, y: height - 3, 'text-anchor': 'middle' }, settings[0]));
  const order = x.map((_, i) => i).sort((a, b) => x[a] - x[b]);
  series.forEach(({ name, colour, points }) => {
    chart.append(svgElement('path', { d: order.map((i, k) => (k ? 'L' : 'M') + x[i] + ' ' + y(points[i].y)).join(''), fill: 'none', stroke: colour, 'stroke-width': 2 }));
    points.forEach((point, i) => {
      if (point.high > point.low) chart.append(svgElement('line', { x1: x[i], x2: x[i], y1: y(Math.max(low, point.low)), y2: y(Math.min(high, point.high)), stroke: colour, 'stroke-width': 1.5, opacity: 0.7 }));
      const dot = svgElement('circle', { cx: x[i], cy: y(point.y), r: 4, fill: colour }, svgElement('title', {}, name + ' at ' + settings[0] + ' = ' + values[i] + ': ' + (unit ? unit(point.y) : rateText(point.y))));
      chart.append(dot);
    });
  });
  return el('div', {}, chart, el('p', { class: 'soft small' }, ...series.flatMap(({ name, colour }) => [el('span', { class: 'legend' }, el('span', { class: 'key', style: { background: colour } }), name), ' '])));
}

function curves() {
  const values = result.points.map((point) => point.values[settings[0]]);
  const rate = (key) => result.points.map((point) => ({ y: point[key], low: point[key] - point[key + '_std'], high: point[key] + point[key + '_std'] }));
  const stages = stageNames.map((stage, i) => ({ name: stage, colour: 'var(--stage-' + i + ')',
    points: result.points.map((point) => ({ y: point.stage_seconds[stage], low: point.stage_seconds[stage], high: point.stage_seconds[stage] })) }));
  return el('div', { class: 'columns' },
    card('Rate', 'Mean over the splits; the bars are one standard deviation.', lineChart(values, [
      { name: 'mean-class rate', colour: 'rgb(var(--right))', points: rate('mean_class_rate') },
      { name: 'overall rate', colour: 'rgb(var(--wrong))', points: rate('overall_rate') }], null, [0, 1])),
    card('Time by stage', 'Summed over threads. Time for features is repeated in every row, even where they were computed once.', lineChart(values, stages, secondsText)));
}

function heatMap(title, note, valueOf, text, kind) {
  const [down, across] = settings;
  const values = result.points.map(valueOf);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const cell = (i) => {
    const share = high > low ? (values[i] - low) / (high - low) : 1;
    return el('td', { class: kind + (share > 0.55 ? ' strong' : ''), 'data-point': i, style: { '--share': (0.08 + 0.92 * share).toFixed(3) } }, text(result.points[i]));
  };
  return card(title, note, el('p', { class: 'axis' }, across), el('div', { class: 'scroll' }, el('table', { class: 'matrix wide' },
    el('thead', {}, el('tr', {}, el('th', { class: 'side' }, down), ...result.vary[across].map((value) => el('th', { class: 'number' }, nameText(value))))),
    el('tbody', {}, ...result.vary[down].map((value, r) => el('tr', {}, el('th', { class: 'side' }, nameText(value)),
      ...result.vary[across].map((_, c) => cell(r * result.vary[across].length + c))))))));
}

const spread = (point, key) => rateText(point[key]) + ' ± ' + rateText(point[key + '_std']);
showPage('Sweep of ' + settings.join(' and '),
  el('h1', {}, 'Effect of ', ...settings.flatMap((setting, i) => [i ? ' and ' : '', nameText(setting)])),
  el('p', { class: 'soft' }, nameText(result.dataset), ', ', countText(result.objects, 'object')),
  ...(settings.length > 1 ? [el('div', { class: 'columns' },
    heatMap('Mean-class rate', 'Mean over the splits.', (point) => point.mean_class_rate, (point) => rateText(point.mean_class_rate), 'right'),
    heatMap('Time', 'Of all stages, added up over threads.', totalSeconds, (point) => secondsText(totalSeconds(point)), 'wrong'))] : [curves()]),
  card('All results', null, el('div', { id: 'points' }, pagedTable(
    [...settings.map((setting) => [setting, 'name']), ['mean-class rate', 'number'], ['overall rate', 'number'], ['time', 'number']], result.points,
    (point) => [...settings.map((setting) => nameText(point.values[setting])), spread(point, 'mean_class_rate'), spread(point, 'overall_rate'), secondsText(totalSeconds(point))]))),
  repeatCard(result.run, result.settings, [['data set', result.dataset]]));
