/** A line in a {@link Panel}. */
export interface Series {
  readonly name: string;
  readonly colour: string;
  readonly dashed?: boolean;
  /** x and y, both above 0; in the order in which they are joined. */
  readonly points: readonly (readonly [number, number])[];
}

/** One diagram with logarithmic axes. */
export interface Panel {
  readonly title: string;
  readonly series: readonly Series[];
}

/** Options for {@link plot}. */
export interface PlotOptions {
  readonly title: string;
  readonly x: string;
  readonly y: string;
  /** What else to say under the title. */
  readonly note?: string;
  /** Panels in a row; default 4. */
  readonly columns?: number;
}

const [WIDTH, HEIGHT] = [230, 190];
const MARGIN = { left: 46, right: 12, top: 26, bottom: 30 } as const;
const [HEAD, LEGEND] = [46, 26];

const escape = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const px = (value: number) => value.toFixed(1);

/** Powers of ten around a range. */
function decades(values: readonly number[]): [number, number] {
  const low = Math.floor(Math.log10(Math.min(...values)) + 1e-9);
  return [low, Math.max(Math.ceil(Math.log10(Math.max(...values)) - 1e-9), low + 1)];
}

const label = (decade: number) =>
  decade >= -2 && decade <= 2
    ? String(Number((10 ** decade).toPrecision(1)))
    : `10<tspan dy="-4" font-size="8">${decade}</tspan>`;

function drawPanel(
  { title, series }: Panel,
  left: number,
  top: number,
  [x0, x1]: [number, number],
  [y0, y1]: [number, number],
): string {
  const [w, h] = [WIDTH - MARGIN.left - MARGIN.right, HEIGHT - MARGIN.top - MARGIN.bottom];
  const X = (value: number) => left + MARGIN.left + ((Math.log10(value) - x0) / (x1 - x0)) * w;
  const Y = (value: number) => top + MARGIN.top + (1 - (Math.log10(value) - y0) / (y1 - y0)) * h;
  const parts = [`<text x="${left + MARGIN.left}" y="${top + 16}" font-weight="600">${escape(title)}</text>`];
  for (let d = x0; d <= x1; d++) {
    const x = px(X(10 ** d));
    parts.push(
      `<path d="M${x} ${px(top + MARGIN.top)}v${px(h)}" stroke="#ddd"/><text x="${x}" y="${px(top + MARGIN.top + h + 14)}" text-anchor="middle" fill="#555">${label(d)}</text>`,
    );
  }
  const step = Math.max(1, Math.ceil((y1 - y0) / 5));
  for (let d = y0; d <= y1; d++) {
    const y = px(Y(10 ** d));
    parts.push(`<path d="M${px(left + MARGIN.left)} ${y}h${px(w)}" stroke="#ddd"/>`);
    if ((d - y0) % step === 0)
      parts.push(
        `<text x="${px(left + MARGIN.left - 5)}" y="${px(Number(y) + 3.5)}" text-anchor="end" fill="#555">${label(d)}</text>`,
      );
  }
  for (const { colour, dashed, points } of series) {
    const shown = points.filter(([x, y]) => x > 0 && y > 0);
    if (shown.length === 0) continue;
    parts.push(
      `<polyline points="${shown.map(([x, y]) => `${px(X(x))},${px(Y(y))}`).join(' ')}" fill="none" stroke="${colour}" stroke-width="1.8"${dashed ? ' stroke-dasharray="5 3"' : ''}/>`,
    );
    parts.push(...shown.map(([x, y]) => `<circle cx="${px(X(x))}" cy="${px(Y(y))}" r="2.6" fill="${colour}"/>`));
  }
  return parts.join('\n');
}

/** Draws panels that share their axes, both logarithmic, as an SVG file with a background of its own. */
export function plot(panels: readonly Panel[], { title, x, y, note, columns = 4 }: PlotOptions): string {
  const points = panels.flatMap(({ series }) => series.flatMap((s) => s.points)).filter(([a, b]) => a > 0 && b > 0);
  if (points.length === 0) throw new RangeError('plot: there is nothing to draw');
  const xs = decades(points.map(([a]) => a)),
    ys = decades(points.map(([, b]) => b));
  const across = Math.min(columns, panels.length);
  const [width, height] = [across * WIDTH, HEAD + LEGEND + Math.ceil(panels.length / across) * HEIGHT];
  const names = new Map(panels.flatMap(({ series }) => series.map((s) => [s.name, s] as const)));
  let at = 12;
  const legend = [...names.values()].map(({ name, colour, dashed }) => {
    const entry = `<path d="M${at} ${HEAD + 10}h24" stroke="${colour}" stroke-width="1.8"${dashed ? ' stroke-dasharray="5 3"' : ''}/><text x="${at + 30}" y="${HEAD + 14}">${escape(name)}</text>`;
    at += 50 + 6.2 * name.length;
    return entry;
  });
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${Math.max(width, Math.ceil(at))} ${height}" font-family="system-ui, sans-serif" font-size="11" fill="#222">`,
    '<rect width="100%" height="100%" fill="#fff"/>',
    `<text x="12" y="22" font-size="14" font-weight="600">${escape(title)}</text><text x="12" y="38" fill="#555">across: ${escape(x)}; up: ${escape(y)}${note === undefined ? '' : `; ${escape(note)}`}</text>`,
    ...legend,
    ...panels.map((panel, i) =>
      drawPanel(panel, (i % across) * WIDTH, HEAD + LEGEND + Math.floor(i / across) * HEIGHT, xs, ys),
    ),
    '</svg>',
    '',
  ].join('\n');
}
