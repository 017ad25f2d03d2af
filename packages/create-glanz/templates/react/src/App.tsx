import { GlanzViewer } from '@glanz/react';
import { useState } from 'react';

export function App() {
  const [status, setStatus] = useState('');
  const [exposure, setExposure] = useState(0);
  return (
    <>
      <GlanzViewer
        src="/push-button.glb"
        alt="A push-button with a green lens"
        cameraControls
        exposureEv={exposure}
        onSample={({ samples, target }) =>
          setStatus(`${samples} of ${target} samples per pixel`)
        }
        onError={({ message }) => setStatus(message)}
      />
      <p>
        <output>{status}</output>
        <label>
          Exposure
          <input
            type="range"
            min="-2"
            max="2"
            step="0.1"
            value={exposure}
            onChange={({ target }) => setExposure(target.valueAsNumber)}
          />
        </label>
      </p>
    </>
  );
}
