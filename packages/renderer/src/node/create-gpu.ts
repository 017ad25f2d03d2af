import { DeviceError } from '../errors';
import { isSoftware } from '../device/software';
import { lavapipeVersion, type GpuDescription } from './adapter-info';
import { createPinned, firstLine, listAdapters, loadDawn, type Dawn } from './dawn';
import { pacePolling } from './polling';
import { packagedSwiftShader } from './swiftshader/unpack';
import {
  canSwitchDrivers,
  chromiumSwiftShaders,
  driverEnvironment,
  installedLavapipe,
  restoreDriverEnvironment,
  switchToDriver,
  type DriverEnvironment,
  type VulkanDriver,
} from './vulkan-driver';

/** Options for {@link createGpu}. */
export interface GpuOptions {
  /**
   * Part of the name of the adapter to use, ignoring case; see {@link listGpus}. Default: the fastest there is. Of several
   * adapters with one name it is the first that the process sees.
   */
  readonly gpu?: string;
  /**
   * Whether to use a software adapter: `auto`, the default, takes one if there is no GPU; `only` always does, for
   * reproducible tests; `never` fails without a GPU.
   */
  readonly software?: 'auto' | 'only' | 'never';
  /**
   * Toggles of Dawn to enable, for features that it hides, e.g. `allow_unsafe_apis` for
   * `chromium-experimental-subgroup-matrix`. Default: none.
   */
  readonly toggles?: readonly string[];
}

/** WebGPU in Node, as {@link createGpu} found it. */
export interface NodeGpu {
  /** Replaces `navigator.gpu`: pass it to `requestDevice({ gpu })`. */
  readonly gpu: GPU;
  /** For people, e.g. `nvidia-h200` or `llvmpipe: Mesa 25.0.7 …`. */
  readonly adapterName: string;
  /** Whether the CPU does the work. */
  readonly software: boolean;
}

/** The oldest Mesa whose lavapipe has what Dawn requires. */
const OLDEST_LAVAPIPE = 25;

interface Source {
  readonly what: string;
  /** A driver to switch to, `undefined` for those in effect, or why there is none. */
  readonly driver: VulkanDriver | string | undefined;
}

/** Places to look for adapters, in order. The slow ones are evaluated only when their turn comes. */
function* sources(options: GpuOptions, user: DriverEnvironment): Generator<Source> {
  const userChose = user.VK_DRIVER_FILES !== undefined || user.VK_ICD_FILENAMES !== undefined;
  yield { what: userChose ? 'the driver in VK_DRIVER_FILES' : 'installed drivers', driver: undefined };
  if (options.software === 'never' || process.platform !== 'linux') return;
  if (!canSwitchDrivers()) {
    yield { what: 'software drivers', driver: 'can be loaded from the main thread only' };
    return;
  }
  yield { what: 'lavapipe', driver: installedLavapipe() ?? 'not installed' };
  const browsers = chromiumSwiftShaders();
  for (const driver of browsers) yield { what: driver.name, driver };
  if (browsers.length === 0) yield { what: "Chromium's SwiftShader", driver: 'no Chromium installed' };
  yield { what: 'SwiftShader from npm', driver: packagedSwiftShader() };
}

/** WebGPU has no field for a card's plain name: `device` is the nearest on hardware, the driver's text on software. */
const adapterName = (info: GPUAdapterInfo) =>
  (isSoftware(info) ? info.description || info.device : info.device || info.description) ||
  info.vendor ||
  'unnamed GPU';

/** Why an adapter will not do; `undefined` if it will. */
function objection(info: GPUAdapterInfo, options: GpuOptions): string | undefined {
  const software = isSoftware(info);
  const name = adapterName(info);
  if (software && options.software === 'never') return `"${name}" is a software GPU`;
  if (!software && options.software === 'only') return `"${name}" is not a software GPU`;
  const mesa = lavapipeVersion(info);
  if (mesa !== undefined && mesa < OLDEST_LAVAPIPE) return `"${name}" is older than Mesa ${OLDEST_LAVAPIPE}`;
  return undefined;
}

/**
 * Tries the drivers now in effect. Gives a GPU, or a reason.
 *
 * @param switched Whether {@link sources} has switched to them: such are software.
 */
async function tryDrivers(dawn: Dawn, options: GpuOptions, switched: boolean): Promise<NodeGpu | string> {
  const requested = options.gpu?.toLowerCase();
  // Listing costs a driver start of its own, so the usual case does without.
  let names: (string | undefined)[] = [undefined];
  if (requested !== undefined || options.software === 'only') {
    const listed = await listAdapters(dawn);
    if (listed.length === 0) return 'no adapter';
    const matching = listed.filter(({ name }) => requested === undefined || name.toLowerCase().includes(requested));
    // Of several with one name, Dawn takes the first.
    names = [...new Set(matching.map(({ name }) => name))];
    if (names.length === 0) return `only ${listed.map((adapter) => `"${adapter.name}"`).join(', ')}`;
  }
  let reason = 'no adapter';
  for (const name of names) {
    try {
      const { toggles = [] } = options;
      const gpu = createPinned(dawn, [
        ...(name === undefined ? [] : [`adapter=${name}`]),
        ...(toggles.length === 0 ? [] : [`enable-dawn-features=${toggles.join()}`]),
        // SwiftShader compiles a store for each element of the constant that clears workgroup memory: a loop in its
        // place halves the time that the denoiser's programs take to compile.
        ...(switched ? ['disable-dawn-features=use_vulkan_zero_initialize_workgroup_memory_extension'] : []),
      ]);
      const adapter = await gpu.requestAdapter({ powerPreference: 'high-performance' });
      if (!adapter) continue;
      const fault = objection(adapter.info, options);
      if (fault === undefined)
        return { gpu, adapterName: name ?? adapterName(adapter.info), software: isSoftware(adapter.info) };
      reason = fault;
    } catch (error) {
      reason = firstLine(error);
    }
  }
  return reason;
}

const FOUND = Symbol.for('glanz.gpu');
interface Memory {
  /** The environment as the user set it, before any driver was switched to. */
  readonly user: DriverEnvironment;
  readonly found: Map<string, Promise<NodeGpu>>;
}

function memory(): Memory {
  const holder = globalThis as { [FOUND]?: Memory };
  return (holder[FOUND] ??= { user: driverEnvironment(), found: new Map() });
}

async function search(options: GpuOptions, user: DriverEnvironment): Promise<NodeGpu> {
  const dawn = await loadDawn();
  restoreDriverEnvironment(user);
  const tried: string[] = [];
  for (const { what, driver } of sources(options, user)) {
    if (typeof driver === 'string') {
      tried.push(`${what}: ${driver}`);
      continue;
    }
    if (driver) switchToDriver(driver);
    const result = await tryDrivers(dawn, options, driver !== undefined);
    if (typeof result !== 'string') {
      if (result.software) pacePolling();
      return result;
    }
    tried.push(`${what}: ${result}`);
  }
  restoreDriverEnvironment(user);
  const wish =
    options.gpu === undefined
      ? options.software === 'only'
        ? 'software GPU'
        : 'usable GPU'
      : `GPU called "${options.gpu}"`;
  const advice =
    options.gpu !== undefined
      ? 'give a part of a listed name'
      : options.software === 'never'
        ? 'install the GPU’s Vulkan driver, or allow a software GPU'
        : 'install a Vulkan driver, or `npm install @sparticuz/chromium` (Linux x64) or Mesa ≥ 25 (package mesa-vulkan-drivers) for a software GPU';
  throw new DeviceError('renderer/no-adapter', `No ${wish} found (${tried.join('; ')}): ${advice}.`);
}

/**
 * WebGPU for Node, through Dawn (the package `webgpu`). Looks for adapters in this order: the driver named by
 * `VK_DRIVER_FILES` or `VK_ICD_FILENAMES` or else the installed ones; Mesa's lavapipe ≥ 25; the SwiftShader of an
 * installed Chromium; the SwiftShader of the optional npm package `@sparticuz/chromium` (Linux x64), which needs
 * nothing else on the machine. The last three set `VK_DRIVER_FILES` of this process and work on the main thread only.
 * Also defines WebGPU's constants (`GPUBufferUsage`, …) globally, as browsers do. With a software adapter it also
 * replaces `setImmediate`, by which Dawn polls, so that polls pause and leave the processor to the adapter; other
 * callers notice nothing.
 *
 * The same options give the same object again; it lives as long as the process, as Dawn needs it to.
 *
 * @throws {DeviceError} `renderer/no-webgpu` when Dawn is missing, `renderer/no-adapter` when there is no adapter,
 * saying all that was tried.
 * @example
 * const { gpu, adapterName, software } = await createGpu();
 * const device = await requestDevice({ gpu });
 */
export function createGpu(options: GpuOptions = {}): Promise<NodeGpu> {
  const { user, found } = memory();
  const key = JSON.stringify([options.gpu ?? null, options.software ?? 'auto', options.toggles ?? []]);
  let result = found.get(key);
  if (!result) {
    // One search at a time: they switch the process's environment.
    const before = [...found.values()];
    result = Promise.allSettled(before).then(() => search(options, user));
    found.set(key, result);
    result.catch(() => found.delete(key));
  }
  return result;
}

/** Describes the adapters of the drivers now in effect. */
async function describe(dawn: Dawn): Promise<GpuDescription[]> {
  const result: GpuDescription[] = [];
  for (const { name, backend } of await listAdapters(dawn)) {
    const adapter = await createPinned(dawn, [`adapter=${name}`])
      .requestAdapter()
      .catch(() => null);
    if (adapter)
      result.push({
        name,
        backend,
        vendor: adapter.info.vendor,
        driver: adapter.info.description,
        software: isSoftware(adapter.info),
      });
  }
  return result;
}

/**
 * Lists the adapters that {@link createGpu} can choose from: those of the installed drivers, and the software GPU that
 * it would fall back to. Identical GPUs are listed separately, with the same name.
 *
 * @throws {DeviceError} `renderer/no-webgpu` when Dawn is missing. No adapter at all gives an empty list.
 */
export async function listGpus(): Promise<GpuDescription[]> {
  const dawn = await loadDawn();
  const { user, found } = memory();
  await Promise.allSettled(found.values());
  const before = driverEnvironment();
  try {
    restoreDriverEnvironment(user);
    const result = await describe(dawn);
    if (result.some((gpu) => gpu.software)) return result;
    try {
      await search({ software: 'only' }, user);
      return [...result, ...(await describe(dawn))];
    } catch {
      return result;
    }
  } finally {
    restoreDriverEnvironment(before);
  }
}
