'use client';

import { GlanzViewer } from '@glanz/react';
import { useState } from 'react';

export function Product({ src, name }: { src: string; name: string }) {
  const [status, setStatus] = useState('');
  return (
    <main>
      <GlanzViewer
        src={src}
        alt={name}
        cameraControls
        onSample={({ samples, target }) =>
          setStatus(`${samples} of ${target} samples per pixel`)
        }
        onError={({ message }) => setStatus(message)}
      />
      <p>
        <strong>{name}</strong>
        <output>{status}</output>
      </p>
    </main>
  );
}
