import { defineGlanzViewer } from '@glanz/element';
import element from '../../examples/element.html?raw';
import * as three from '../../examples/three-scene';
import * as viewer from '../../examples/viewer';

Object.assign(window, {
  examples: { ...viewer, three },
  putElement: () => {
    defineGlanzViewer();
    (document.querySelector('#element') as HTMLElement).append(
      document.createRange().createContextualFragment(element),
    );
    return document.querySelector('glanz-viewer');
  },
});
