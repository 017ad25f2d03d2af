// What a React project may write. tools/check-published.mjs compiles it against the packed declarations, with the types
// of React 18 and 19.
import { GlanzViewer, type GlanzViewerElement, type GlanzViewerProps } from '@glanz/react';
import { useRef } from 'react';

export function Component() {
  const ref = useRef<GlanzViewerElement>(null);
  return (
    <GlanzViewer
      ref={ref}
      src="/chair.glb"
      alt="An oak chair"
      cameraControls
      exposureEv={1.2}
      variantName={null}
      className="chair"
      style={{ height: '60vh' }}
      title="Chair"
      tabIndex={0}
      role="figure"
      aria-busy
      data-sku="7"
      hidden={false}
      onClick={(event) => event.currentTarget.viewer?.pick(event.clientX, event.clientY)}
      onPointerEnter={(event) => event.currentTarget.dismissPoster()}
      onLoad={({ scene }) => scene.meshes.length}
      onError={({ code }) => code.startsWith('gltf/')}
    >
      <img slot="poster" src="/chair.webp" alt="" />
    </GlanzViewer>
  );
}

export function Tag() {
  const ref = useRef<GlanzViewerElement>(null);
  return (
    <glanz-viewer
      ref={ref}
      src="/chair.glb"
      alt="An oak chair"
      camera-controls=""
      auto-rotate
      exposure-ev={1.2}
      samples="64"
      class="chair"
      title="Chair"
      onClick={(event) => event.currentTarget.viewer?.pick(event.clientX, event.clientY)}
    >
      <button slot="hotspot-seat" data-position="0 0.45 0">
        Seat
      </button>
    </glanz-viewer>
  );
}

// @ts-expect-error A flag is no text.
export const wrongFlag: GlanzViewerProps = { cameraControls: 'yes' };
// @ts-expect-error There is no such prop.
export const wrongName: GlanzViewerProps = { cameraControl: true };
// @ts-expect-error The event has a detail of its own, not React's event.
export const wrongEvent: GlanzViewerProps = { onLoad: (event) => event.currentTarget };
// @ts-expect-error An exposure is a number.
export const wrongAttribute = <glanz-viewer exposure-ev="bright" />;
// @ts-expect-error React 18 would write false as text, which turns the flag on.
export const wrongTagFlag = <glanz-viewer camera-controls={false} />;
// @ts-expect-error There is no such attribute.
export const wrongTagName = <glanz-viewer scr="/chair.glb" />;
