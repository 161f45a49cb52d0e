'use strict';
// The report of spincat evaluate.

const result = data.result;
const categories = result.categories;
const tested = data.tested;
const testedFolder = commonFolder(tested.files);
const objectName = (i) => tested.files[i].slice(testedFolder.length);
const rowTotals = result.confusion.map((row) => row.reduce((sum, count) => sum + count, 0));

function protocolText() {
  if (result.run.protocol === 'leave-one-out') return 'each object named by judges trained on all others';
  if (result.run.protocol === 'across') return 'all objects of ' + result.run.test_dataset + ', once';
  const seeds = result.run.split_seeds.length;
  return countText(result.splits * seeds, 'random split') + (seeds > 1 ? ' (' + result.splits + ' for each of ' + seeds + ' seeds)' : '') +
    ', ' + shareText(result.run.test_share) + ' of each category tested';
}

function headline() {
  const figure = (id, title, key) => el('div', { id },
    el('div', { class: 'soft' }, title),
    el('div', { class: 'big' }, el('span', { class: 'rate' }, rateText(result[key])),
      result.run.protocol === 'splits' ? el('small', {}, ' ± ', el('span', { class: 'spread' }, rateText(result[key + '_std']))) : null),
    el('div', { class: 'soft small' }, '95 % interval ', el('span', { class: 'interval' }, spanText(result[key + '_interval']))));
  return el('div', { class: 'headline' },
    figure('mean-class-rate', 'Mean-class rate', 'mean_class_rate'), figure('overall-rate', 'Overall rate', 'overall_rate'),
    result.confidence ? el('div', { id: 'confidence' }, el('div', { class: 'soft' }, 'AUC of the confidence (right vs wrong)'),
      el('div', { class: 'big' }, rateText(result.confidence.right_or_wrong_auc)),
      el('div', { class: 'soft small' }, 'area under the curve; ' + rateText(result.confidence.mean) + ' on average')) : null);
}

// The objects behind one cell, those that were named so most often first.
function showCell(panel, truth, named) {
  const found = [];
  for (let i = 0; i < tested.files.length; ++i) {
    if (tested.truth[i] !== truth) continue;
    const times = tested.named[i].filter((name) => name === named).length;
    if (times > 0) found.push({ i, times, of: tested.named[i].length });
  }
  found.sort((a, b) => b.times / b.of - a.times / a.of || a.i - b.i);
  const title = el('h3', { id: 'cell-title' }, nameText(categories[truth]), truth === named ? ' named right' : ' named ', truth === named ? null : nameText(categories[named]));
  panel.replaceChildren(title,
    el('p', { class: 'soft small' }, countText(result.confusion[truth][named], 'time'), ', ', countText(found.length, 'object')),
    pagedTable([['object', 'name'], ['times', 'number']], found, (each) => [nameText(objectName(each.i)), each.times + ' of ' + each.of]));
}

function matrixCell(truth, named) {
  const count = result.confusion[truth][named];
  const share = count > 0 ? count / rowTotals[truth] : 0;
  const kind = (truth === named ? 'right' : 'wrong') + (share > 0.6 ? ' strong' : '');
  // Even a single mistake must be seen.
  const cell = el('td', { class: count > 0 ? kind : '', 'data-truth': truth, 'data-named': named, style: { '--share': count > 0 ? (0.12 + 0.88 * share).toFixed(3) : '0' } });
  if (count > 0) {
    cell.append(el('button', { type: 'button', 'aria-pressed': 'false', title: categories[truth] + ' named ' + categories[named] + ': ' + count + ' (' + shareText(share) + ')' }, count));
  }
  return cell;
}

function matrixCard() {
  const many = categories.length > 20;
  const table = el('table', { class: 'matrix' + (many ? ' many' : ''), id: 'matrix' },
    el('thead', {}, el('tr', {}, el('th', { class: 'side' }, ''), ...categories.map((name) => el('th', { class: 'above', scope: 'col', title: name }, el('span', {}, nameText(name)))))),
    el('tbody', {}, ...categories.map((name, truth) => el('tr', {}, el('th', { class: 'side', scope: 'row', title: name }, nameText(name)),
      ...categories.map((other, named) => matrixCell(truth, named))))));
  const panel = el('div', { class: 'panel', id: 'cell', 'aria-live': 'polite' }, el('p', { class: 'soft' }, 'Choose a cell to see its objects.'));
  table.querySelector('tbody').onclick = (event) => {
    const button = event.target.closest('button');
    if (!button) return;
    for (const other of table.querySelectorAll('[aria-pressed="true"]')) other.setAttribute('aria-pressed', 'false');
    button.setAttribute('aria-pressed', 'true');
    const cell = button.parentElement;
    showCell(panel, Number(cell.dataset.truth), Number(cell.dataset.named));
  };
  return card('Confusion matrix', 'Rows are what objects are, columns what they were named; counts over all splits, shaded by their share of the row.',
    el('div', { class: many ? '' : 'beside' }, el('div', {}, el('p', { class: 'axis' }, 'named as'), el('div', { class: 'scroll' + (many ? ' tall' : '') }, table)), panel));
}

function ratesCard() {
  const grid = el('div', { class: 'rates' + (categories.length > 30 ? ' tall' : ''), id: 'category-rates' });
  const fill = (order) => grid.replaceChildren(...order.flatMap((c) => {
    const rate = result.category_rates[categories[c]];
    const name = el('span', { class: 'name', title: categories[c] }, nameText(categories[c]));
    if (rate.rate === null) return [name, el('span', {}), el('span', { class: 'number', 'data-category': c }, 'not tested')];
    const [low, high] = rate.interval;
    return [name,
      el('div', { class: 'track', title: '95 % interval ' + spanText(rate.interval) }, el('div', { class: 'bar', style: { width: 100 * rate.rate + '%' } }),
        el('div', { class: 'span', style: { left: 100 * low + '%', width: 100 * (high - low) + '%' } })),
      el('span', { class: 'number', 'data-category': c }, rateText(rate.rate))];
  }));
  const given = categories.map((_, c) => c);
  const byRate = [...given].sort((a, b) => result.category_rates[categories[a]].rate - result.category_rates[categories[b]].rate || a - b);
  let sorted = false;
  const button = el('button', { type: 'button', class: 'no-print', onclick: () => { sorted = !sorted; fill(sorted ? byRate : given); button.textContent = sorted ? 'By name' : 'Worst first'; } }, 'Worst first');
  fill(given);
  const section = card('Rate of each category', 'The share of its objects that were named right, with the 95 % interval.', grid);
  section.querySelector('h2').replaceWith(el('div', { class: 'row' }, el('h2', {}, 'Rate of each category'), button));
  return section;
}

function confusedCard() {
  const pairs = [];
  result.confusion.forEach((row, truth) => row.forEach((count, named) => {
    if (truth !== named && count > 0) pairs.push({ truth, named, count, share: count / rowTotals[truth] });
  }));
  pairs.sort((a, b) => b.share - a.share || b.count - a.count);
  if (pairs.length === 0) return card('Most often confused', 'Every object was named correctly.');
  return card('Most often confused', 'By the share of the category’s tests.', el('div', { id: 'confused' },
    pagedTable([['is', 'name'], ['was named', 'name'], ['times', 'number'], ['share', 'number']], pairs, (pair) =>
      [nameText(categories[pair.truth]), nameText(categories[pair.named]), pair.count, shareText(pair.share)], 12)));
}

function seedsCard() {
  if (result.seeds.length < 2) return null;
  return card('Each seed', 'Mean-class and overall rate over ' + result.splits + ' splits each.', pagedTable(
    [['seed', ''], ['mean-class rate', 'number'], ['overall rate', 'number']], result.seeds, (seed) =>
      [seed.seed, rateText(seed.mean_class_rate) + ' ± ' + rateText(seed.mean_class_rate_std), rateText(seed.overall_rate) + ' ± ' + rateText(seed.overall_rate_std)]));
}

// Every object: those named wrong most often first.
function objectsCard() {
  const rightShare = (i) => tested.named[i].filter((name) => name === tested.truth[i]).length / tested.named[i].length;
  const mostNamed = (i) => {
    const counts = new Map();
    for (const name of tested.named[i]) counts.set(name, (counts.get(name) || 0) + 1);
    return [...counts].sort((a, b) => b[1] - a[1] || a[0] - b[0])[0][0];
  };
  const all = tested.files.map((_, i) => i).filter((i) => tested.named[i].length > 0).sort((a, b) => rightShare(a) - rightShare(b) || a - b);
  const place = el('div', { class: 'panel', id: 'objects' });
  const fill = (wanted) => {
    const found = all.filter((i) => (objectName(i) + '\n' + categories[tested.truth[i]]).toLowerCase().includes(wanted.toLowerCase()));
    place.replaceChildren(pagedTable([['object', 'name'], ['is', 'name'], ['most often named', 'name'], ['right', 'number']], found, (i) =>
      [nameText(objectName(i)), nameText(categories[tested.truth[i]]), nameText(categories[mostNamed(i)]), shareText(rightShare(i))]));
  };
  fill('');
  const search = el('input', { type: 'search', class: 'no-print', placeholder: 'Find an object or category', 'aria-label': 'Find an object or category', oninput: () => fill(search.value) });
  return card('All tested objects', 'Those that are hardest first.', search, place);
}

function leftOutCard() {
  if (result.left_out.length + result.skipped.length === 0) return null;
  return card('What took no part', null,
    result.left_out.length ? pagedTable([['category', 'name'], ['why', 'name']], result.left_out, (each) => [nameText(each.category), nameText(each.reason)]) : null,
    result.skipped.length ? pagedTable([['file', 'name'], ['why', 'name']], result.skipped, (each) => [nameText(each.file), nameText(each.error)]) : null);
}

showPage('Evaluation of ' + result.dataset,
  el('h1', {}, 'Accuracy on ', nameText(result.dataset)),
  el('p', { class: 'soft' }, countText(result.objects, 'object'), ', ', countText(categories.length, 'category', 'categories'), ', ', nameText(protocolText())),
  headline(), matrixCard(),
  el('div', { class: 'columns' }, ratesCard(), confusedCard()),
  ...[seedsCard(), objectsCard(),
    card('Time by stage', 'Added up over threads; everything took ' + secondsText(result.seconds) + '.', stageBar(result.stage_seconds)),
    leftOutCard(),
    repeatCard(result.run, result.settings, [['data set', result.dataset]])].filter((section) => section !== null));
