import { createElement } from 'react';
import { renderToString } from 'react-dom/server';
import { describe, expect, it } from 'vitest';
import { GlanzViewer } from '../src/index';

describe('on a server', () => {
  it('renders the tag with its attributes and its poster, and nothing runs', () => {
    expect(typeof document).toBe('undefined');
    const html = renderToString(
      createElement(
        GlanzViewer,
        {
          src: 'chair.glb',
          alt: 'An oak chair',
          cameraControls: true,
          autoRotate: false,
          fieldOfView: '30deg',
          exposureEv: 1.5,
          samples: null,
          dracoDecoder: '/draco.js',
          ktx2Transcoder: '/basis.js',
          denoise: '/denoise.js',
          preview: 'raw',
          animationName: 'walk',
          autoplay: true,
          orientation: '0 0 90deg',
          shadowIntensity: 0.5,
          withCredentials: false,
          onPlay: () => undefined,
          className: 'hero',
          style: { height: 400 },
          onLoad: () => undefined,
        },
        createElement('img', { slot: 'poster', src: 'chair.webp', alt: '' }),
      ),
    );
    // React announces the image to the browser before.
    const from = html.indexOf('<glanz-viewer ');
    const tag = html.slice(from, html.indexOf('>', from) + 1);
    for (const attribute of [
      'src="chair.glb"',
      'alt="An oak chair"',
      'camera-controls=""',
      'field-of-view="30deg"',
      'exposure-ev="1.5"',
      'draco-decoder="/draco.js"',
      'ktx2-transcoder="/basis.js"',
      'denoise="/denoise.js"',
      'preview="raw"',
      'animation-name="walk"',
      'autoplay=""',
      'orientation="0 0 90deg"',
      'shadow-intensity="0.5"',
      'class="hero"',
      'style="height:400px"',
    ])
      expect(tag).toContain(attribute);
    for (const absent of ['auto-rotate', 'samples', 'with-credentials', 'onPlay', 'onLoad', 'on-load', 'suppress'])
      expect(tag).not.toContain(absent);
    expect(html).toContain('<img slot="poster" src="chair.webp" alt=""/>');
  });

  it('leaves a file for the browser', () => {
    expect(renderToString(createElement(GlanzViewer, { src: new Blob([]) }))).toBe('<glanz-viewer></glanz-viewer>');
  });

  it('writes HTML attributes as HTML names them, and no handler', () => {
    const props = {
      title: 'Chair',
      tabIndex: 0,
      role: 'figure',
      hidden: false,
      inert: true,
      lang: 'en',
      draggable: false,
      contentEditable: false,
      'aria-busy': false,
      'data-sku': 7,
      className: 'hero',
      id: 'chair',
      onClick: () => undefined,
      onLoad: () => undefined,
    } as const;
    const html = renderToString(createElement(GlanzViewer, props));
    const attributes = html
      .slice(html.indexOf('<glanz-viewer') + 13, html.indexOf('>'))
      .trim()
      .split(/ (?=[\w-]+=)/)
      .sort();
    // Names of HTML's attributes are the same in any case.
    expect(attributes.map((text) => text.replace(/^[\w-]+/, (name) => name.toLowerCase())).sort()).toEqual([
      'aria-busy="false"',
      'class="hero"',
      'contenteditable="false"',
      'data-sku="7"',
      'draggable="false"',
      'id="chair"',
      'inert=""',
      'lang="en"',
      'role="figure"',
      'tabindex="0"',
      'title="Chair"',
    ]);
  });
});
