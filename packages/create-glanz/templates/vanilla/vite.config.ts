import { defineConfig } from 'vite';

// Workers of these packages start only where the development server leaves
// their modules as they are.
export default defineConfig({
  optimizeDeps: { exclude: ['@glanz/bvh', '@glanz/gltf'] },
});
