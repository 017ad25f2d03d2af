#!/usr/bin/env bash
# Packs what a bare x86-64 Linux machine with an NVIDIA driver needs to run WebGPU programs in Node: this machine's Node,
# Dawn's Node binding, and Debian's Vulkan and GLVND loaders, into DIR (default .gpu, about 28 MiB, ignored by git).
#   tools/gpu/pack.sh [DIR]                       here, in the repository's root, after an install
#   . .gpu/setup.sh && $GPU_NODE bench.mjs        there
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
dir=${1:-.gpu}
limit_mib=60

dawn=$(find -L node_modules/webgpu -path '*dist/linux-x64/dawn.node' 2>/dev/null | head -1)
[ -n "$dawn" ] || { echo "pack.sh: node_modules/webgpu is missing: run npm run build first" >&2; exit 1; }
command -v apt-get >/dev/null || { echo "pack.sh: needs apt-get (Debian or Ubuntu) to fetch the Vulkan loader" >&2; exit 1; }
mkdir -p "$dir"

pack() { [ -f "$2" ] && [ "$2" -nt "$1" ] || xz -T0 -6 -c "$1" > "$2"; }
pack "$(readlink -f "$(command -v node)")" "$dir/node.xz"
pack "$dawn" "$dir/dawn.node.xz"
cp "$(dirname "$dawn")/../../index.js" "$dir/webgpu-index.js"

if ! ls "$dir"/libvulkan1*.deb >/dev/null 2>&1; then
  lists=$(mktemp -d)
  trap 'rm -rf "$lists"' EXIT
  mkdir -p "$lists/partial"
  options=(-oAPT::Architecture=amd64 -oAPT::Architectures=amd64 "-oDir::State::Lists=$lists")
  apt-get "${options[@]}" update >/dev/null
  (cd "$dir" && apt-get "${options[@]}" download libvulkan1 libegl1 libglvnd0 libopengl0 libgl1 libglx0 libgles2 >/dev/null 2>&1)
fi

cat > "$dir/setup.sh" <<'S'
# Source this there, from the folder that holds this one. Sets GPU_NODE (the node to run) and GPU_WEBGPU (Dawn's entry,
# which Glanz imports instead of the package "webgpu").
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
runtime=${GPU_RUNTIME:-/tmp/gpu-runtime}
module=$runtime/node_modules/webgpu
mkdir -p "$module/dist/linux-x64"
for file in "$here"/*.deb; do dpkg -x "$file" /; done
ldconfig
[ -x "$runtime/node" ] || { xz -dc "$here/node.xz" > "$runtime/node" && chmod +x "$runtime/node"; }
[ -f "$module/dist/linux-x64/dawn.node" ] || xz -dc "$here/dawn.node.xz" > "$module/dist/linux-x64/dawn.node"
cp "$here/webgpu-index.js" "$module/index.js"
echo '{"name":"webgpu","type":"module","main":"index.js","exports":"./index.js"}' > "$module/package.json"
export GPU_NODE=$runtime/node GPU_WEBGPU=$module/index.js XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-/tmp}
# Container images mount the driver beside the usual places.
for icd in /usr/local/nvidia/share/vulkan/icd.d/nvidia_icd.json /usr/share/vulkan/icd.d/nvidia_icd.json /etc/vulkan/icd.d/nvidia_icd.json; do
  [ -f "$icd" ] && export VK_DRIVER_FILES=$icd && break
done
egl=/usr/local/nvidia/share/glvnd/egl_vendor.d/10_nvidia.json
[ -f "$egl" ] && export __EGL_VENDOR_LIBRARY_FILENAMES=$egl
[ -f "$here/../.gpu-bench/commit.sh" ] && . "$here/../.gpu-bench/commit.sh"
:
S

mkdir -p .gpu-bench
size=$(du -sm "$dir" .gpu-bench | awk '{ sum += $1 } END { print sum }')
echo "$dir and .gpu-bench: ${size} MiB of ${limit_mib}"
[ "$size" -lt "$limit_mib" ] || { echo "pack.sh: too large to carry" >&2; exit 1; }
