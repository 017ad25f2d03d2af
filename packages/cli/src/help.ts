import { flagsHelp } from './render-flags';

/** The sections about the other commands, for the manual page and for `glanz help COMMAND`. */
const COMMANDS = {
  convert: `CONVERTING CAD FILES
  glanz convert PART [-o FILE.glb] [--lod N] [--materials FILE] [--strip] [...]

  Turns a CAD file (.step, .iges, .brep) into .glb. It needs the package
  @glanz/cad.
  -o, --output FILE     Default: the model's name with .glb, in this folder.
      --lod N           Levels of detail, each of a quarter of the triangles:
                        part.glb, part.lod1.glb, part.lod2.glb. Default 1.
      --materials FILE  JSON that translates names and colours of parts to
                        materials; see the package.
      --strip           Leave out names and metadata.
      --tolerance MM    Maximum distance of the triangles from the surface, in
                        millimetres. Default: a thousandth of the model's size.
`,
  info: `INSPECTING A MODEL
  glanz info MODEL [--scene SCENE] [--json]

  Prints the contents of a model without rendering it: triangles, parts, size,
  materials, images, cameras, lights, variants, animations, memory, the
  metadata of the file, and every warning.
`,
  bench: `MEASURING THE SPEED
  glanz bench [MODEL] [--size WxH] [--samples N] [--runs N] [--gpu NAME]
              [--json]

  Renders a built-in scene (49 spheres, 1.6 million triangles), or a model, and
  prints the time per sample and the time to the first sample.
      --size WxH        Pixels. Default 512x512.
      --samples N       Samples per pixel of a run. Default 64.
      --runs N          Number of runs, whose median is printed. Default 3.
`,
  merge: `RENDERING ON SEVERAL MACHINES
  glanz merge A.film B.film [...] -o FILE... [--exposure EV] [--tone-map NAME]
              [--bits N] [--json]

  Adds up the samples of several renders of the same image, whose options
  differ in --samples-from and --samples alone:
    glanz render m.glb --samples 500 -o a.film
    glanz render m.glb --samples-from 500 --samples 500 -o b.film
    glanz merge a.film b.film -o image.png
  The result equals that of one run with 1000 samples, up to rounding. The order
  of the films does not matter. No GPU is needed. All films are in memory at
  once, so merge many large films in groups.
  -o, --output FILE     .png, .hdr, .exr (image and variance), or .film again.
`,
  video: `VIDEOS
  glanz video MODEL [-o VIDEO.mp4] [--degrees D] [--animation NAME]
              [--seconds S] [--fps N] [--shutter F] [--resume] [...]

  Renders the frames of a video and encodes them with ffmpeg. The other options
  are those of glanz render and apply to each frame: size, samples, light,
  denoising, and so on.
  -o, --output FILE     .mp4, .mov, .webm or .mkv; or numbered images without
                        ffmpeg: 'frames/{frame}.png', or .exr, .hdr. Default:
                        the model's name with .mp4.
      --degrees D       Move the camera D degrees around the model, at the same
                        distance; negative: to the left. Default 360, unless
                        --animation or --camera is given.
      --elevation D     ... from D degrees above. Default 20.
      --animation NAME  Play an animation of a glTF model, by name or number. It
                        repeats if the video is longer.
      --seconds S       Default: the length of the animation, or 4.
      --fps N           Frames per second. Default 30.
      --shutter F       Motion blur: fraction of the time between two frames in
                        which the shutter is open, 0 to 1. 0.5 is a shutter of
                        180 degrees. Default 0: none.
      --shutter-times N Pose the model at N times of an open shutter. Default:
                        for each sample. Fewer are faster for deformed meshes.
      --codec NAME      h264, h265, vp9 or av1. Default: h264, or vp9 for .webm.
      --crf N           Constant rate factor: lower values give better quality
                        and larger files. Default 18 for h264, 22 for h265,
                        24 for vp9, 28 for av1.
      --frames DIR      Keep the frames as PNG files in DIR. Default: beside the
                        video until it is encoded.
      --ffmpeg PATH     Default: the ffmpeg in PATH.
      --resume          Skip frames that an earlier run has finished.
  Without ffmpeg, or without an encoder for the codec, the command fails before
  it renders anything.
`,
  farm: `RENDERING A BATCH ON SEVERAL MACHINES
  glanz farm submit BATCH --redis URL [--split N] [...]
  glanz farm work --redis URL [--gpu NAME]... [--until-empty]
  glanz farm status --redis URL [--metrics]
  glanz farm retry | cancel ID... | --all --redis URL
  glanz farm manifest BATCH --manifest FILE [...]
  glanz farm task BATCH [--image N] [...]
  glanz farm serve --redis URL [--port N] [--host NAME]
  glanz farm submit BATCH --openjd FILE [...]
  glanz farm clean --older-than 30d [--store DIR]

  submit queues the images of a batch file, and work renders them, on any
  number of machines with access to the folder of the store. The content of an
  image identifies it: model, environment, variant, view, options, version. An
  image that the store has is copied and not rendered again, so submitting a
  batch again resumes it. Without --redis, submit renders on this machine, as
  glanz render --batch BATCH --resume does. The queue needs Redis (appendonly
  yes, maxmemory-policy noeviction) and the packages bullmq and ioredis. All
  options of glanz render are defaults for the images.
      --redis URL       redis://HOST:6379. Default: GLANZ_REDIS.
      --queue NAME      Name of the queue, so that several farms can share a
                        Redis server. Default glanz.
      --store DIR       A folder that all machines can access. Default
                        .glanz-farm. Or s3://BUCKET/PREFIX, which needs
                        @aws-sdk/client-s3; credentials and region are
                        configured as for AWS's tools. Images then stay in the
                        bucket until manifest, or a second submit, copies them;
                        work copies them with --output-root.
      --s3-endpoint URL A server compatible with S3. Default:
                        AWS_ENDPOINT_URL_S3 or AWS_ENDPOINT_URL.
      --store-cache DIR A folder of this machine for downloads from the bucket.
                        Default: glanz/farm in XDG_CACHE_HOME or
                        ~/.cache.
      --output-root DIR submit: the folder in which all files are written.
                        Default: that of the batch. work: the path of the same
                        folder on this machine.
      --split N         Split images with more than N samples into several jobs,
                        whose films are merged as by glanz merge, and then
                        denoised with --denoise. Not with --noise.
      --gpu NAME        work, task: start a process for each GPU named; "all"
                        for all GPUs. "NAME #2" is the second of several GPUs
                        with the same name; each process then has access to its
                        own GPU only, which needs root or user namespaces.
      --until-empty     work: exit when the queue is empty.
      --lock S          work: another worker takes the job of a killed worker
                        after S seconds. Default 30.
      --metrics         status: print metrics in Prometheus' text format.
      --image N         task: render these images in this process, without a
                        queue: 3, 0,4, 10-19, or red/front. Default: all.
      --part N          task: render only this part of a split image.
      --openjd FILE     submit: write a job template of Open Job Description,
                        whose tasks are glanz farm task, and queue nothing.
      --port N          serve: a read-only page about the farm. Default 4180;
      --host NAME       ... at 127.0.0.1: only this machine can open it.
      --older-than AGE  clean: delete entries of the store that were not used
                        for this time: 30d, 12h, 90m.
      --manifest FILE   manifest: write the finished images as JSON, in the
                        order of the batch; the exit status is 1 while images
                        are missing.
  On SIGTERM and Ctrl-C, work stores the samples of its job and returns the job
  to the queue. A job whose GPU was lost goes to another worker at once. A job
  with invalid input is not retried; one that crashes the renderer's process is
  tried three times. status lists the failed jobs, with the end of their logs.
`,
  serve: `RUNNING THE PLAYGROUND
  glanz serve [--port N] [--host NAME] [--json]

  Serves the playground from this package, without network access: open the
  address that it prints, and drop a model onto the page. Ctrl-C ends it.
      --port N          Default 4173; 0 selects a free port.
      --host NAME       Default 127.0.0.1: only this machine can open it.
`,
} as const;

/** The manual page. */
export const HELP = `NAME
  glanz - path-trace glTF models to images, with or without a GPU

SYNOPSIS
  glanz render MODEL [-o FILE]... [--env FILE] [--size WxH] [--samples N] [...]
  glanz render MODEL --variant all --view front --view iso [...]
  glanz render --batch FILE [--resume] [--gpu NAME]... [...]
  glanz convert PART [-o FILE.glb] [--lod N] [--materials FILE] [--strip] [...]
  glanz video MODEL [-o VIDEO.mp4] [--degrees D] [--animation NAME] [...]
  glanz merge A.film B.film [...] -o FILE
  glanz farm submit BATCH | work | status [--redis URL] [...]
  glanz info MODEL | bench [MODEL] | serve
  glanz --list-gpus
  glanz help [COMMAND] | --help | --version

DESCRIPTION
  Renders a glTF 2.0 model (.glb or .gltf), an .obj with its .mtl, an .stl, or
  USD (.usdz, .usdc, .usda), and writes the image in each requested format. A
  model without a camera is framed from the front right, slightly from above.
  Without --env and without an environment of its own, the model is lit by a
  neutral photo studio. Uses the best GPU, or the CPU if there is none.

  Progress goes to stderr, the output of --json, info and bench to stdout.
  Ctrl-C writes the samples accumulated so far; a second Ctrl-C exits at once.
  When the GPU is lost, rendering continues on a new device, with the same
  result.

IMAGE
  -o, --output FILE     Where to write; the ending decides the format. May be
                        given several times. Default: the model's name with
                        .png, in the current folder.
                          .png  sRGB, tone-mapped, 8 or 16 bits
                          .exr  linear, with the layers albedo, normal, depth,
                                position, variance, objectId, materialId and
                                one for each light group; half or 32-bit floats
                          .hdr  linear, Radiance RGBE
                          .film the samples, for glanz merge
      --size WxH        Pixels. Default 1024x768.
      --bits N          8 or 16 for .png (default 8), 16 or 32 for .exr
                        (default 16).
      --transparent     Short for --background transparent.
      --catcher PART    Render only the shadows and the light that other parts
                        cast on this part, such as a floor. May be given
                        several times.
      --denoise [NAME]  Denoise the image for .png and .hdr with the networks of
                        Open Image Denoise: fast, balanced (default) or best.
                        .exr keeps the film and adds the layer denoised. Where
                        noise is not visible, the image does not change.
                        Needs the package @glanz/denoise-weights.
      --exposure EV     Brighten (or darken) by stops, .png only. Default 0.
                        Or as a camera does, for scenes in cd/m2:
                        f/8,1/125,iso200.
      --tone-map NAME   neutral, aces, agx, reinhard or linear, .png only.
                        Default neutral, which keeps base colours.

LIGHT AND VIEW
      --env FILE        Environment: a lat-long .hdr or .exr, "studio" (default
                        unless the model has its own) or "none".
      --env-rotation D  Rotate the environment about the vertical axis by D
                        degrees, counter-clockwise seen from above.
      --env-intensity F Multiply the light of the environment by F.
      --camera CAMERA   A camera of the model by name or number (from 0), or
                        JSON:
                          '{"position":[3,2,4],"target":[0,1,0],"fov":35}'
                        with the vertical angle in degrees; optional "up",
                        "lens_radius" and "focus_distance" in metres, and
                        "lens_blades" with "lens_rotation" in degrees.
                        "projection" may be "orthographic", with "height" in
                        metres, or "panorama" (360 degrees). Or a .json file
                        with the same content. Default: the model's first
                        camera, or one that frames it.

RENDERING
${flagsHelp({ biased: false })}
      --samples-from N  Index of the first sample, default 0: a render with
                        --samples-from 100 continues another with 100 samples.
                        See glanz merge.

BIASED OPTIONS
  These remove or blur some light, which lowers noise or time; all are off by
  default.
${flagsHelp({ biased: true })}

MODEL
      --scene SCENE     A scene of the file, by name or number (from 0).
      --animation NAME  Pose the model by this animation, by name or number, ...
      --time S          ... at S seconds. Default: the rest pose, or the first
                        animation if --time is given.
      --variant NAME    Variant of KHR_materials_variants, by name or number;
                        "all" for each. May be given several times.

SEVERAL IMAGES
  Each variant is rendered from each view; common data stays on the GPU.
      --view VIEW       front, back, left, right, top, bottom, front-right,
                        front-left, back-right, back-left, iso; or an azimuth
                        and an elevation in degrees, "30,20"; or any value of
                        --camera. May be given several times.
      --turntable N     N views around the model, from the same distance, named
                        turntable-000 and so on,
      --elevation D     ... from D degrees above. Default 20.
      --output FILE     {model}, {variant} and {view} in the name are replaced.
                        -{variant}-{view} is appended where names would be the
                        same.
      --batch FILE      Images from a file. JSON: a list of objects whose keys
                        are the names of these options and "model", or
                        { "defaults": {...}, "images": [...] }. CSV: a line of
                        names, then one line per image. Options on the command
                        line are the defaults of the images. Paths are relative
                        to the file.
      --resume          Skip images that an earlier run has finished, if neither
                        options nor files have changed since. The run records
                        this in .glanz-journal.jsonl beside the images.
      --checkpoint FILE Save the samples to FILE while rendering, at most every
                        30 seconds, and when the run is interrupted. The same
                        command continues from there; --samples may be raised. A
                        file of another image is an error. The file is deleted
                        when the image is written. The name may contain
                        {model}, {variant} and {view}.
      --gpu NAME        Given several times, or "all": each GPU takes the next
                        image when it has finished one. For several GPUs with
                        the same name, use glanz farm task. When a GPU cannot
                        recover, the others continue its image.
      --output-root DIR The folder in which the batch file may write. Default:
                        the folder of the batch file.
  An image that fails does not stop the others; the exit status is that of the
  first failure. With Ctrl-C, unfinished images are not written.

${COMMANDS.convert}
${COMMANDS.info}
${COMMANDS.bench}
${COMMANDS.merge}
${COMMANDS.video}
${COMMANDS.farm}
${COMMANDS.serve}
MACHINE
      --list-gpus       List the adapters that can render, and exit.
      --gpu NAME        Use the GPU whose name contains NAME; "software" for the
                        CPU.
      --json            Print one JSON object on stdout: files, samples,
                        timings, statistics, adapter; or the error. For
                        several: { ok, images: [...], total, skipped, failed }.
  -q, --quiet           No progress, no summary.
  -h, --help            Print this page.
  -V, --version         Print the version.

EXIT STATUS
  0 success · 1 rendering failed · 2 wrong usage · 3 a file cannot be read or
  is invalid · 4 a file cannot be written · 5 no usable GPU, or it was lost ·
  70 an internal error of glanz · 130 interrupted by Ctrl-C after writing the
  samples so far (143 by SIGTERM, 129 by SIGHUP)

EXAMPLES
  glanz render helmet.glb
  glanz render helmet.glb -o helmet.png -o helmet.exr --samples 1024
  glanz render chair.gltf --env studio.hdr --env-rotation 90 --exposure 0.5
  glanz render part.glb --transparent --size 512x512 -o part.png --json
  glanz render shoe.glb --variant all --view front --view iso --view 30,20 \\
    -o 'out/{variant}-{view}.png' --resume
  glanz render ring.glb --turntable 36 --elevation 15 -o 'ring/{view}.png'
  glanz video ring.glb --seconds 6 --shutter 0.5 -o 'ring/{frame}.png'
  glanz render --batch catalogue.csv --samples 512 --resume --json
  glanz info shoe.glb
  glanz convert part.step -o part.glb --lod 3 --materials map.json --strip
  glanz render room.glb --camera '{"position":[0,1.6,3],"target":[0,1.2,0]}'
`;

/** The manual page, or the section about a command. */
export function helpOf(topic: string | undefined): string {
  const section =
    topic !== undefined && Object.hasOwn(COMMANDS, topic) ? COMMANDS[topic as keyof typeof COMMANDS] : undefined;
  if (section === undefined) return HELP;
  return `${section}
      --json            Print one JSON object on stdout: result or error.
  -q, --quiet           No progress, no summary.

EXIT STATUS
${/EXIT STATUS\n([\s\S]*?)\n\n/.exec(HELP)?.[1] ?? ''}

  glanz --help prints the whole manual.
`;
}
