// Draws the charts of a report from the JSON in the page.
'use strict';
(() => {
const data = JSON.parse(document.getElementById('data').textContent);
const summary = data.summary;

// Okabe and Ito's colours, each with a mark, so that nothing depends on colour alone.
const looks = {
  'W-RoI': ['#0072B2', 'circle'], 'W-RoI+motion': ['#0B3D66', 'rectRounded'],
  'W-Full': ['#56B4E9', 'rect'], 'W-Full+motion': ['#3A7D9E', 'rectRounded'],
  'G-Full': ['#009E73', 'triangle'], 'G-Full+motion': ['#00543D', 'star'],
  'R-Full-0.1': ['#C4907C', 'circle'], 'R-Full-0.2': ['#8C4F3A', 'rect'], 'R-Full-0.2+motion': ['#57291B', 'triangle'],
  'D-Full': ['#7B52AB', 'crossRot'], 'O-Full-0.2': ['#D55E00', 'rectRot'], 'O-Full-0.4': ['#E69F00', 'rectRot'],
  'O-RoI-0.2': ['#CC79A7', 'star'], 'O-RoI-0.4': ['#A0527F', 'star'],
  'O-RoI+rays-0.2': ['#7A6A00', 'cross'], 'O-RoI+rays-0.4': ['#B3A000', 'cross'],
  'oracle': ['#333333', 'crossRot'], 'oracle+motion': ['#777777', 'star']
};
const look = who => {
  const [color, mark] = looks[who.model] || ['#B00020', 'line'];  // of another version
  return {color, mark, dash: who.guidance === 'astar' ? [] : [6, 4]};
};
const modelOf = who => (data.model_names || {})[who.model] || who.model;
const nameOf = who => modelOf(who) + (who.guidance === 'astar' ? ', A*' : ', ' + who.guidance);
const same = (a, b) => a.model === b.model && a.guidance === b.guidance;

Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.font.family = 'system-ui, "DejaVu Sans", sans-serif';
Chart.defaults.color = '#1d2530';
Object.assign(Chart.defaults.plugins.legend.labels, {usePointStyle: true, boxWidth: 9, boxHeight: 9});
Chart.defaults.plugins.legend.position = 'bottom';

// Points with `low` and `high` get an interval bar along the value axis.
const intervals = {
  id: 'intervals',
  beforeDatasetsDraw(chart, args, options) {
    if (!options.axis) return;
    const {ctx, scales} = chart;
    chart.data.datasets.forEach((set, s) => {
      if (!chart.isDatasetVisible(s)) return;
      chart.getDatasetMeta(s).data.forEach((element, i) => {
        const point = set.data[i];
        if (point.low === undefined) return;
        const scale = scales[options.axis];
        const from = scale.getPixelForValue(point.low), to = scale.getPixelForValue(point.high);
        ctx.save();
        ctx.strokeStyle = set.borderColor;
        ctx.lineWidth = 1.2;
        ctx.beginPath();
        if (options.axis === 'x') { ctx.moveTo(from, element.y); ctx.lineTo(to, element.y); }
        else { ctx.moveTo(element.x, from); ctx.lineTo(element.x, to); }
        ctx.stroke();
        ctx.restore();
      });
    });
  }
};
Chart.register(intervals);

function draw(place, title, height, config, wide) {
  const figure = document.createElement('figure');
  if (wide) figure.className = 'wide';
  const caption = document.createElement('figcaption');
  caption.textContent = title;
  const box = document.createElement('div');
  box.className = 'canvas';
  box.style.height = height + 'px';
  const canvas = document.createElement('canvas');
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', title);
  box.append(canvas);
  figure.append(caption, box);
  place.append(figure);
  new Chart(canvas, config);
}
function withPlace(name, use) {
  const place = document.getElementById('chart-' + name);
  if (place) use(place);
}
const axis = (text, more) => Object.assign({title: {display: true, text}}, more);
const percent = share => 100 * share;
/// The lower end of an axis of rates, so that no interval is cut off.
const lowest = datasets => Math.max(0, Math.min(...datasets.flatMap(
    set => set.data.map(point => 10 * Math.floor(point.low / 10)))));
/// Whether two conditions are the same but for the speed.
const alike = (a, b) => ['planner', 'pose_error', 'latency_scale', 'unknown', 'air', 'distance', 'updates'].every(
    key => a[key] === b[key]);
const inReference = cell => cell.condition.name === data.reference;

withPlace('success', place => {
  const cells = summary.cells.filter(cell => inReference(cell) && cell.scenario);
  const names = summary.scenarios.filter(name => cells.some(cell => cell.scenario === name));
  const present = summary.contenders.filter(who => cells.some(cell => same(cell, who)));
  const step = 0.72 / Math.max(1, present.length);
  const datasets = present.map((who, w) => ({
    label: nameOf(who), borderColor: look(who).color, clip: 8,
    backgroundColor: who.guidance === 'astar' ? look(who).color : '#ffffff', borderWidth: 2,
    pointStyle: look(who).mark, pointRadius: 5,
    data: cells.filter(cell => same(cell, who)).map(cell => ({
      x: percent(cell.success.share), low: percent(cell.success.interval[0]),
      high: percent(cell.success.interval[1]),
      y: names.indexOf(cell.scenario) + (w - (present.length - 1) / 2) * step}))
  }));
  draw(place, 'Success by scenario', 90 + names.length * Math.max(34, 13 * present.length), {
    type: 'scatter', data: {datasets},
    options: {
      plugins: {intervals: {axis: 'x'}},
      scales: {
        x: axis('success, %', {min: lowest(datasets), max: 100}),
        y: {min: -0.5, max: names.length - 0.5, reverse: true,
            afterBuildTicks: scale => { scale.ticks = names.map((name, value) => ({value})); },
            ticks: {autoSkip: false, callback: value => names[value]},
            grid: {drawOnChartArea: false}}
      }
    }
  }, true);
});

withPlace('speed', place => {
  const limits = summary.speed_limits.filter(limit => alike(limit, summary.conditions[0]));
  const scenarios = [...new Set(limits.map(limit => limit.scenario))];
  for (const scenario of scenarios) {
    const who = summary.contenders.filter(
        one => limits.some(l => l.scenario === scenario && same(l, one)));
    const datasets = who.map((one, w) => ({
      label: nameOf(one), borderColor: look(one).color, backgroundColor: look(one).color,
      clip: 8, borderDash: look(one).dash, pointStyle: look(one).mark, pointRadius: 5,
      data: summary.cells.filter(cell => cell.scenario === scenario && same(cell, one) &&
                                         alike(cell.condition, summary.conditions[0]))
        // Beside one another, but never far from their speed.
        .map(cell => ({x: cell.condition.speed_m_s + Math.min(0.06, 0.3 / who.length) * (w - (who.length - 1) / 2),
                       y: percent(cell.success.share), low: percent(cell.success.interval[0]),
                       high: percent(cell.success.interval[1])}))
        .sort((a, b) => a.x - b.x)
    }));
    const speeds = datasets.flatMap(set => set.data.map(point => point.x));
    const least = lowest(datasets);
    datasets.push({label: '95 %', pointStyle: 'line', borderColor: '#777777', borderDash: [2, 4], pointRadius: 0,
                   borderWidth: 1,
                   data: [{x: Math.min(...speeds), y: 95}, {x: Math.max(...speeds), y: 95}]});
    draw(place, scenario, 300, {
      type: 'line', data: {datasets},
      options: {plugins: {intervals: {axis: 'y'}},
                scales: {x: axis('speed, m/s', {type: 'linear', grace: '8%'}),
                         y: axis('success, %', {min: least, max: 100})}}
    });
  }
});

// Curves have no marks: the legend shows a piece of the line with its dashes.
const lineLegend = {plugins: {legend: {labels: {
  pointStyleWidth: 42, boxHeight: 9,
  generateLabels: chart => Chart.defaults.plugins.legend.labels.generateLabels(chart).map(
      label => ({...label, lineDash: chart.data.datasets[label.datasetIndex].borderDash || []}))
}}}};

withPlace('clearance', place => {
  for (const group of data.clearances) {
    const datasets = group.curves.map(curve => ({
      label: nameOf(curve), borderColor: look(curve).color, backgroundColor: look(curve).color,
      borderDash: look(curve).dash, pointRadius: 0, borderWidth: 2.5, pointStyle: 'line',
      data: curve.quantiles_m.map((x, i) => ({x, y: 100 * i / (curve.quantiles_m.length - 1)}))
    }));
    datasets.push({label: '0.30 m: collision below', borderColor: '#777777', borderDash: [2, 4],
                   pointRadius: 0, borderWidth: 2, pointStyle: 'line', data: [{x: 0.3, y: 0}, {x: 0.3, y: 100}]});
    const guidance = group.guidance === 'astar' ? 'with A*' : `with ${group.guidance} guidance`;
    draw(place, `Minimum true clearance of a flight ${guidance}: share of flights below it, on the same ` +
                `${group.courses} course${group.courses === 1 ? '' : 's'}`, 340, {
      type: 'line', data: {datasets},
      options: {...lineLegend, scales: {x: axis('minimum clearance, m', {type: 'linear', min: 0}),
                                        y: axis('flights, %', {min: 0, max: 100})}}
    }, true);
  }
});

withPlace('command', place => {
  for (const group of data.latencies) {
    const bars = (label, color, key) => ({
      label, backgroundColor: color, borderColor: color,
      data: group.bars.map(bar => bar[key]), barPercentage: 0.8});
    draw(place, `Latency from sensor to command (logarithmic), on the same ${group.courses} ` +
                `course${group.courses === 1 ? '' : 's'}`, 90 + 46 * group.bars.length, {
      type: 'bar',
      data: {labels: group.bars.map(nameOf), datasets: [
        bars('p50', '#0072B2', 'p50_ms'), bars('p95', '#56B4E9', 'p95_ms'), bars('max', '#B8C4CE', 'max_ms')]},
      options: {indexAxis: 'y', scales: {x: axis('ms', {type: 'logarithmic'})}}
    }, true);
  }
});

withPlace('stages', place => {
  const colors = {filter: '#0072B2', update: '#E69F00', astar: '#009E73', straight: '#B8C4CE',
                  primitives: '#CC79A7', '3dvfh': '#A0527F'};
  const colorOf = {};
  const who = data.stages.filter(one => one.stages.length > 0);
  for (const one of who) one.stages.forEach(stage => { colorOf[stage.stage] = colors[stage.of]; });
  const stages = Object.keys(colorOf);
  for (const [key, title] of [['p50_ms', 'Stages, median'], ['p95_ms', 'Stages, 95th percentile']]) {
    draw(place, title, 110 + 30 * who.length, {
      type: 'bar',
      data: {labels: who.map(nameOf), datasets: stages.map(stage => ({
        label: stage, backgroundColor: colorOf[stage] || '#777777',
        data: who.map(one => (one.stages.find(s => s.stage === stage) || {})[key] || 0)}))},
      options: {indexAxis: 'y', scales: {x: axis('ms per scan', {stacked: true}), y: {stacked: true}}}
    });
  }
});

withPlace('memory', place => {
  const datasets = data.memory.map(curve => ({
    label: modelOf(curve), borderColor: look(curve).color, backgroundColor: look(curve).color,
    pointRadius: 0, borderWidth: 2, pointStyle: 'line',
    data: curve.megabytes_by_m.map(([x, y]) => ({x, y}))}));
  draw(place, 'Memory of the world model', 320, {
    type: 'line', data: {datasets},
    options: {...lineLegend, scales: {x: axis('distance flown, m', {type: 'linear'}), y: axis('MB', {type: 'logarithmic'})}}
  }, true);
});
document.body.dataset.charts = String(document.querySelectorAll('canvas').length);
})();
