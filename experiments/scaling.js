'use strict';
// The page of experiments/scaling: the speed-up of more workers (the paper's Figure 12), with the fitted formula.

const result = data.result;
const svgElement = (tag, attributes, ...children) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};
const aloneSeconds = (study, problem) => study.samples.find(([size, ranks, threads]) => size === problem && ranks * threads === 1)[3];

// Both axes by their logarithm: the fitted curve, what was measured of the largest problem as dots, and as many times as
// fast as there are workers, dashed.
function chart(study) {
  const [width, height, left, top, bottom] = [560, 340, 46, 12, 42];
  const one = study.predicted[0][2];
  const most = study.predicted.at(-1)[0];
  const x = (workers) => left + (width - left - 14) * Math.log(workers) / Math.log(most);
  const y = (gain) => top + (height - top - bottom) * (1 - Math.log(Math.max(gain, 0.5) / 0.5) / Math.log(most / 0.5));
  const picture = svgElement('svg', { class: 'chart', viewBox: '0 0 ' + width + ' ' + height, role: 'img', 'aria-label': 'speed-up against workers' });
  for (let tick = 1; tick <= most; tick *= 4) {
    picture.append(svgElement('line', { class: 'grid', x1: left, x2: width - 14, y1: y(tick), y2: y(tick) }),
      svgElement('text', { x: left - 8, y: y(tick) + 4, 'text-anchor': 'end' }, tick),
      svgElement('text', { x: x(tick), y: height - 22, 'text-anchor': 'middle' }, tick));
  }
  picture.append(svgElement('text', { x: (left + width) / 2, y: height - 4, 'text-anchor': 'middle' }, 'workers (threads of all processes)'),
    svgElement('path', { d: 'M' + x(1) + ' ' + y(1) + 'L' + x(most) + ' ' + y(most), fill: 'none', stroke: 'var(--soft)', 'stroke-dasharray': '5 5' }),
    svgElement('path', { class: 'fitted', d: study.predicted.map(([workers, , seconds], i) => (i ? 'L' : 'M') + x(workers) + ' ' + y(one / seconds)).join(''),
      fill: 'none', stroke: 'rgb(var(--right))', 'stroke-width': 2 }));
  for (const [problem, ranks, threads, seconds] of study.samples.filter(([size]) => size === study.problem)) {
    const gain = aloneSeconds(study, problem) / seconds;
    picture.append(svgElement('circle', { cx: x(ranks * threads), cy: y(gain), r: 4.5, fill: 'rgb(var(--wrong))' },
      svgElement('title', {}, ranks + ' processes of ' + threads + ' threads: ' + 'speed-up ' + gain.toFixed(2))));
  }
  const key = (colour, text) => el('span', { class: 'legend' }, el('span', { class: 'key', style: { background: colour } }), text);
  return el('div', {}, picture, el('p', { class: 'soft small' }, key('rgb(var(--wrong))', 'measured'), ' ', key('rgb(var(--right))', 'the formula'), ' ', key('var(--soft)', 'as many times as workers')));
}

// The formula of docs/results/scaling.md with the numbers that were found; terms that the fit left out are not there.
function formula(model) {
  const number = (value) => Number(value.toPrecision(3));
  const terms = [[model.constant, ' s'], [model.per_unit, ' s N'], [model.per_work, ' s W / p'], [model.per_training, ' s V / p'],
    [model.launch, ' s [R > 1]'],
    [model.per_byte, ' s ((R − 1) sent + (R − 1) / R returned)']];
  return 'T = ' + (terms.filter(([value]) => value > 0).map(([value, rest]) => number(value) + rest).join(' + ') || '0');
}

function study(each) {
  const one = each.predicted[0][2];
  return card(each.name, 'Of the largest problem measured, ' + each.problem + '.', chart(each),
    el('pre', { class: 'formula' }, formula(each.model)),
    el('p', { class: 'soft small' }, 'p workers in R processes; N is what one process does alone, W the work that is distributed, V that of training judges, sent and returned bytes (docs/results/scaling.md). ',
      'The formula is off by at most ' + shareText(each.model.largest_error) + ' of a measurement.'),
    el('h3', {}, 'Measured'),
    el('div', { class: 'measured' }, pagedTable([['problem', 'number'], ['processes', 'number'], ['threads each', 'number'], ['time', 'number'], ['speed-up', 'number']], each.samples,
      ([problem, ranks, threads, seconds]) => [problem, ranks, threads, secondsText(seconds), (aloneSeconds(each, problem) / seconds).toFixed(2)])),
    el('h3', {}, 'By the formula'),
    el('div', { class: 'predicted' }, pagedTable([['workers', 'number'], ['hosts', 'number'], ['time', 'number'], ['speed-up', 'number']], each.predicted,
      ([workers, hosts, seconds]) => [workers, hosts, secondsText(seconds), (one / seconds).toFixed(1)])));
}

showPage('Scaling',
  el('h1', {}, 'What more processes and threads bring'),
  el('p', { class: 'soft' }, 'Medians of ', countText(result.rounds, 'round'), ' under ', nameText(result.mpi), '; load of the machine when it ended: ', result.load.map((load) => load.toFixed(1)).join(', '), '.'),
  el('div', { class: 'columns' }, ...result.studies.map(study)),
  result.divisions.length ? card('The paper’s division and ours', 'Images returned to the first process, which encodes them; or only their sums.', el('div', { id: 'divisions' }, pagedTable(
    [['work', 'name'], ['images returned', 'number'], ['sums returned', 'number'], ['ratio', 'number']], result.divisions, (row) => row.map(String)))) : '');
