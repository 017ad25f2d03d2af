import react from '@vitejs/plugin-react';
import { defineConfig } from 'vite';

// Workers of these packages start only where the development server leaves
// their modules as they are.
export default defineConfig({
  plugins: [react()],
  optimizeDeps: { exclude: ['@glanz/bvh', '@glanz/gltf'] },
});
