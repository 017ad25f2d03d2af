import '@glanz/element/define';

// Tests put elements into the page and hear what they say.
const bytes = (base64: string) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
const heard: { type: string; detail: Record<string, unknown>; samples: number | undefined }[] = [];
const plain = (detail: object | null) =>
  Object.fromEntries(
    Object.entries(detail ?? {}).filter(([, value]) => typeof value !== 'function' && typeof value !== 'object'),
  );
Object.assign(window, {
  heard,
  file: (base64: string, name: string) => new File([bytes(base64)], name),
  put: (attributes: Record<string, string>, children = '') => {
    const element = document.createElement('glanz-viewer');
    for (const type of [
      'load',
      'progress',
      'error',
      'warning',
      'sample',
      'converged',
      'camera-change',
      'device-lost',
      'device-restored',
      'poster-dismissed',
      'variant-applied',
      'play',
      'pause',
      'loop',
      'finished',
      'preload',
      'model-visibility',
      'environment-change',
      'render-scale',
    ] as const)
      element.addEventListener(
        type,
        (event) =>
          void heard.push({
            type,
            detail: plain((event as CustomEvent<object | null>).detail),
            samples: element.viewer?.sampleCount,
          }),
      );
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    // Children come as markup, as they would in a page.
    element.append(document.createRange().createContextualFragment(children));
    (document.querySelector('#place') as HTMLElement).append(element);
    return element;
  },
});
