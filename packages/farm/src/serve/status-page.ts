/** The page of `statusServer`, in one file: it reads `/status.json` every two seconds. */
export const STATUS_PAGE = /* html */ `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Farm</title>
<style>
:root { color-scheme: light dark; font: 15px/1.45 system-ui, sans-serif }
body { margin: 0 auto; padding: 1.5rem; max-width: 70rem }
h1 { font-size: 1.2rem; margin: 0 0 .8rem }
h2 { font-size: 1rem; margin: 1.6rem 0 .5rem }
progress { width: 100%; height: .8rem }
dl { display: flex; flex-wrap: wrap; gap: .2rem 1.6rem; margin: .6rem 0 0 }
dl div { display: flex; gap: .4rem }
dt { opacity: .75 }
dd { margin: 0; font-variant-numeric: tabular-nums; font-weight: 600 }
table { border-collapse: collapse; width: 100% }
td, th { text-align: left; padding: .2rem .8rem .2rem 0; border-bottom: 1px solid #8884; vertical-align: top }
#recent { display: grid; grid-template-columns: repeat(auto-fill, minmax(9rem, 1fr)); gap: .8rem }
figure { margin: 0; min-width: 0 }
figure img { width: 100%; aspect-ratio: 4/3; object-fit: contain; background: #8882; border-radius: 4px }
figcaption { font-size: .8rem; overflow-wrap: anywhere }
pre { margin: .3rem 0 0; white-space: pre-wrap; overflow-wrap: anywhere; font-size: .8rem }
#error { color: #c22 }
</style>
<h1>Farm</h1>
<progress id="bar" aria-label="Jobs done" max="1" value="0"></progress>
<dl id="counts"></dl>
<p id="error" role="status"></p>
<h2>Failed</h2><div id="failed"></div>
<h2>Workers</h2><table><thead><tr><th>Host<th>GPU<th>Job<th>Samples<th>Done</tr></thead><tbody id="workers"></tbody></table>
<h2>Latest images</h2><div id="recent"></div>
<script>
const at = (id) => document.getElementById(id);
const make = (name, text, ...children) => {
  const element = document.createElement(name);
  if (text !== undefined) element.textContent = text;
  element.append(...children);
  return element;
};
const time = (seconds) => {
  const two = (n) => String(Math.floor(n)).padStart(2, '0');
  return (seconds >= 3600 ? Math.floor(seconds / 3600) + ':' : '') + two((seconds / 60) % 60) + ':' + two(seconds % 60);
};
function show({ status, recent, deadLetters }) {
  const { waiting, active, delayed, failed, done, secondsLeft, workers } = status;
  const left = waiting + active + delayed;
  at('bar').max = Math.max(1, done + left + failed);
  at('bar').value = done;
  const counts = { Done: done, Active: active, Waiting: waiting, Delayed: delayed, Failed: failed };
  if (secondsLeft > 0) counts['Time left'] = time(secondsLeft);
  at('counts').replaceChildren(
    ...Object.entries(counts).map(([name, value]) => make('div', undefined, make('dt', name), make('dd', value))));
  at('failed').replaceChildren(...(deadLetters.length === 0 ? [make('p', 'None.')] : deadLetters.map((letter) => {
    const details = make('details', undefined, make('summary', letter.label + ': ' + letter.reason));
    details.append(make('pre', letter.id + '\\n' + letter.log.join('\\n')));
    details.open = at('failed').querySelector('[data-id="' + letter.id + '"]')?.open ?? false;
    details.dataset.id = letter.id;
    return details;
  })));
  at('workers').replaceChildren(...workers.map(({ host, pid, gpu, job, done }) => make('tr', undefined,
    make('td', host + ' ' + pid), make('td', gpu), make('td', job ? job.label : 'idle'),
    make('td', job ? job.samples + '/' + job.of : ''), make('td', done))));
  const known = new Map([...at('recent').children].map((figure) => [figure.dataset.id, figure]));
  at('recent').replaceChildren(...recent.filter(({ image }) => image >= 0).map(({ id, label, seconds, image }) => {
    const old = known.get(id);
    if (old) return old;
    const img = make('img');
    img.src = '/thumbnail/' + id + '/' + image;
    img.alt = label;
    img.loading = 'lazy';
    const link = make('a', undefined, img);
    link.href = '/result/' + id + '/' + image;
    const figure = make('figure', undefined, link, make('figcaption', label + ', ' + seconds.toFixed(1) + ' s'));
    figure.dataset.id = id;
    return figure;
  }));
}
async function update() {
  try {
    const response = await fetch('/status.json');
    if (!response.ok) throw new Error(await response.text());
    show(await response.json());
    at('error').textContent = '';
  } catch (error) {
    at('error').textContent = 'No answer: ' + error.message;
  }
  setTimeout(update, 2000);
}
void update();
</script>
</html>
`;
