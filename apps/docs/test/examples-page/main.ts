import { defineGlanzViewer } from '@glanz/element';
import element from '../../examples/element.html?raw';
import * as compat from '../../examples/three-compat';
import * as live from '../../examples/three-live';
import * as three from '../../examples/three-scene';
import * as viewer from '../../examples/viewer';

Object.assign(window, {
  examples: { ...viewer, three, live, compat },
  putElement: () => {
    defineGlanzViewer();
    (document.querySelector('#element') as HTMLElement).append(
      document.createRange().createContextualFragment(element),
    );
    return document.querySelector('glanz-viewer');
  },
});
