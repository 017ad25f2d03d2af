import type { Context } from '../ui/context';
import { codeSnippet } from './snippet';
import { htmlSnippet, reactSnippet } from './snippet-element';
import { viewerSnippet } from './snippet-viewer';

/** What code is written for. */
export type CodeKind = 'renderer' | 'viewer' | 'html' | 'react';

/** Code that shows what the page shows. */
export function codeFor(kind: CodeKind, { opened, store: { state }, rig, session }: Context): string {
  const { scene, name, title } = opened();
  if (kind === 'viewer') return viewerSnippet(scene, name, state, rig.camera());
  if (kind === 'renderer') {
    const { tracer } = session;
    return codeSnippet(scene, name, state, rig.camera(), tracer ? [tracer.width, tracer.height] : [1024, 768]);
  }
  const perspective = rig.camera({ ...state, lens: { ...state.lens, projection: 'perspective' } });
  const fov = perspective.type === 'perspective' ? (perspective.yfov * 180) / Math.PI : 30;
  const view = { name, title, orbit: rig.view, fov };
  return kind === 'html' ? htmlSnippet(scene, state, view) : reactSnippet(scene, state, view);
}
