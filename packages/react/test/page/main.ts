import { GlanzViewer, type GlanzViewerElement, type GlanzViewerProps } from '@glanz/react';
import { createElement, StrictMode, useState } from 'react';
import { createRoot, hydrateRoot } from 'react-dom/client';

// Tests give props through the window and hear what comes of them.
const heard: string[] = [];
const seen: { element: GlanzViewerElement | null } = { element: null };
let give: (props: GlanzViewerProps | null) => void = () => undefined;

function App({ first }: { readonly first: GlanzViewerProps }) {
  const [props, setProps] = useState<GlanzViewerProps | null>(first);
  give = setProps;
  if (!props) return createElement('p', null, 'gone');
  return createElement(GlanzViewer, {
    ref: (element: GlanzViewerElement | null) => void (seen.element = element),
    onLoad: () => void heard.push('load'),
    onConverged: ({ samples }) => void heard.push(`converged ${samples}`),
    onWarning: ({ code }) => void heard.push(`warning ${code}`),
    onError: ({ code }) => void heard.push(`error ${code}`),
    ...props,
  });
}

const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
Object.assign(window, {
  heard,
  seen,
  give: (props: GlanzViewerProps | null) => give(props),
  file: (base64: string, name: string) => new File([bytes(base64)], name),
  start: (first: GlanzViewerProps, html?: string) => {
    const root = document.querySelector('#root') as HTMLElement;
    const app = createElement(StrictMode, null, createElement(App, { first }));
    if (html === undefined) createRoot(root).render(app);
    else {
      root.innerHTML = html;
      hydrateRoot(root, app);
    }
  },
});
