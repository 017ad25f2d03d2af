/** @type {import('next').NextConfig} */
export default {
  // A lockfile in a folder above does not become the root.
  turbopack: { root: import.meta.dirname },
};
