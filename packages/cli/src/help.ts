import { flagsHelp } from './render-flags';

/** What each of the smaller commands takes, for the manual page and for `glanz help COMMAND`. */
const COMMANDS = {
  convert: `CONVERTING
  glanz convert PART [-o FILE.glb] [--lod N] [--materials FILE] [--strip] [...]

  Turns a CAD file (.step, .iges, .brep) into .glb. It needs the package
  @glanz/cad.
  -o, --output FILE     Default: the model's name with .glb, in this folder.
      --lod N           Levels of detail, each of a quarter of the triangles:
                        part.glb, part.lod1.glb, part.lod2.glb. Default 1.
      --materials FILE  JSON that translates names and colours of parts to
                        materials; see the package.
      --strip           Leave out names and metadata.
      --tolerance MM    How far triangles may lie from the surface, millimetres.
                        Default: a thousandth of the model's size.
`,
  info: `LOOKING
  glanz info MODEL [--scene SCENE] [--json]

  Prints what a model holds, without rendering it: triangles, parts, size,
  materials, images, cameras, lights, variants, animations, memory, what the
  file says of itself, and every warning.
`,
  bench: `MEASURING
  glanz bench [MODEL] [--size WxH] [--samples N] [--runs N] [--gpu NAME]
              [--json]

  Renders a built-in scene (49 balls, 1.6 million triangles), or a model, and
  prints how long a sample takes, and how long it takes until the first.
      --size WxH        Pixels. Default 512x512.
      --samples N       Of each run. Default 64.
      --runs N          The middle one counts. Default 3.
`,
  merge: `RENDERING ON SEVERAL MACHINES
  glanz merge A.film B.film [...] -o FILE... [--exposure EV] [--tone-map NAME]
              [--bits N] [--json]

  Adds up the samples of several renders of the same image, whose options
  differ in --samples-from and --samples alone:
    glanz render m.glb --samples 500 -o a.film
    glanz render m.glb --samples-from 500 --samples 500 -o b.film
    glanz merge a.film b.film -o image.png
  The result is that of one run with 1000 samples, within the rounding of its
  sums. Their order does not matter. It needs no GPU; all films are in memory
  at once, so merge many large ones group by group.
  -o, --output FILE     .png, .hdr, .exr (image and variance), or .film again.
`,
  video: `VIDEOS
  glanz video MODEL [-o VIDEO.mp4] [--degrees D] [--animation NAME]
              [--seconds S] [--fps N] [--shutter F] [--resume] [...]

  Renders the frames of a video, and has ffmpeg encode them. The other options
  are those of glanz render, which hold for each frame: size, samples, light,
  denoising, and so on.
  -o, --output FILE     .mp4, .mov, .webm or .mkv; or numbered images without
                        ffmpeg: 'frames/{frame}.png', or .exr, .hdr. Default:
                        the model's name with .mp4.
      --degrees D       The camera goes D degrees around the model, at the same
                        distance; negative: to the left. Default 360, unless
                        --animation or --camera is given.
      --elevation D     ... from D degrees above. Default 20.
      --animation NAME  Plays an animation of a glTF model, by name or number;
                        again from its start where the video is longer.
      --seconds S       Default: the length of the animation, or 4.
      --fps N           Frames a second. Default 30.
      --shutter F       Motion blur: share of the time between two frames in
                        which the shutter is open, 0 to 1. 0.5 is a shutter of
                        180 degrees. Default 0: none.
      --shutter-times N Pose the model at N times of an open shutter. Default:
                        for each sample. Fewer cost less for deformed meshes.
      --codec NAME      h264, h265, vp9 or av1. Default: h264, or vp9 for .webm.
      --crf N           Constant rate factor: smaller is better and larger.
                        Default 18 for h264, 22 h265, 24 vp9, 28 av1.
      --frames DIR      Keep the frames as PNG files in DIR. Default: beside the
                        video until it is encoded.
      --ffmpeg PATH     Default: the ffmpeg in PATH.
      --resume          Leave out frames that an earlier run has finished.
  Without ffmpeg, or an encoder for the video's codec, the command ends before
  anything is rendered.
`,
  farm: `MANY IMAGES ON MANY MACHINES
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
  number of machines that see the store's folder. An image has an identity by
  its content: model, environment, variant, view, options, version. What the
  store has is copied and not rendered again, so that a batch is resumed by
  submitting it. Without --redis, submit renders on this machine, as
  glanz render --batch BATCH --resume does. The queue needs Redis (appendonly
  yes, maxmemory-policy noeviction) and the packages bullmq and ioredis. All
  options of glanz render are defaults for the images.
      --redis URL       redis://HOST:6379. Default: GLANZ_REDIS.
      --queue NAME      Several farms may share a Redis. Default glanz.
      --store DIR       A folder that all machines see. Default .glanz-farm. Or
                        s3://BUCKET/PREFIX, which needs @aws-sdk/client-s3:
                        credentials and region as AWS's tools take them. Images
                        then stay in the bucket until manifest, or submitting
                        again, copies them; work copies them with --output-root.
      --s3-endpoint URL Another server of S3's protocol. Default:
                        AWS_ENDPOINT_URL_S3 or AWS_ENDPOINT_URL.
      --store-cache DIR A folder of this machine for what it has downloaded of
                        the bucket. Default: glanz/farm in XDG_CACHE_HOME or
                        ~/.cache.
      --output-root DIR submit: the folder below which all files are written.
                        Default: that of the batch. work: the same folder where
                        this machine sees it under another name.
      --split N         Images with more samples than N become several jobs,
                        whose films are added up as glanz merge does, and then
                        denoised where --denoise asks for it. Not with --noise.
      --gpu NAME        work, task: one for each; "all" for each that there is.
                        Of several with one name "NAME #2" is the second; each
                        process then sees its own alone, which needs root or
                        user namespaces.
      --until-empty     work: end when the queue is empty.
      --lock S          work: S seconds after a worker was killed its job goes
                        to another one. Default 30.
      --metrics         status: Prometheus text.
      --image N         task: render these images in this process, without a
                        queue: 3, 0,4, 10-19, or red/front. Default: all.
      --part N          task: of an image in parts this one alone.
      --openjd FILE     submit: write a job template of Open Job Description,
                        whose tasks are glanz farm task, and queue nothing.
      --port N          serve: a read-only page about the farm. Default 4180;
      --host NAME       ... 127.0.0.1: nobody else can reach it.
      --older-than AGE  clean: delete what the store has that was not used for
                        so long: 30d, 12h, 90m.
      --manifest FILE   manifest: JSON of the images that are finished, in the
                        order of the batch; the exit status is 1 while some are
                        missing.
  SIGTERM and Ctrl-C let work keep the samples of its job and give it back. A
  job whose GPU was lost goes to another worker at once; one whose input is
  wrong is not tried again, and one that ends its renderer's process is tried
  three times. status lists what was given up, with the end of its log.
`,
  serve: `THE PLAYGROUND
  glanz serve [--port N] [--host NAME] [--json]

  Serves the playground from this package, without a network: open the address
  that it prints, and drop a model onto the page. Ctrl-C ends it.
      --port N          Default 4173; 0 takes any that is free.
      --host NAME       Default 127.0.0.1: nobody else can reach it.
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
  USD (.usdz, .usdc, .usda), and writes the image in each format asked for. A
  model without a camera is framed from the front right, a little from above;
  without --env it stands in a neutral photo studio. Uses the best GPU there is,
  or the processor if there is none.

  Progress goes to stderr; stdout has what --json, info and bench print. Ctrl-C
  writes what has been accumulated so far; a second Ctrl-C ends at once. When
  the GPU is lost, rendering continues on a new device, with the same pixels.

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
      --catcher PART    Show of this part, a floor say, only the shadows and the
                        light that the others throw on it. May be given
                        several times.
      --denoise [NAME]  Denoise the image for .png and .hdr, by Open Image
                        Denoise's networks: fast, balanced (default) or best.
                        .exr keeps the film and gets the layer denoised. Where
                        the film's noise is not seen the image stays as it is.
                        Needs the package @glanz/denoise-weights.
      --exposure EV     Brighten (or darken) by stops, .png only. Default 0.
                        Or as a camera does, for scenes in cd/m2:
                        f/8,1/125,iso200.
      --tone-map NAME   neutral, aces, agx, reinhard or linear, .png only.
                        Default neutral: base colours stay what they are.

LIGHT AND VIEW
      --env FILE        Environment: a lat-long .hdr or .exr, "studio" (default
                        unless the model brings its own) or "none".
      --env-rotation D  Turn it about the vertical axis by D degrees,
                        counter-clockwise seen from above.
      --env-intensity F Multiply their light.
      --camera CAMERA   A camera of the model by name or number (from 0), or
                        JSON:
                          '{"position":[3,2,4],"target":[0,1,0],"fov":35}'
                        with the vertical angle in degrees; optional "up",
                        "lens_radius" and "focus_distance" in metres, and
                        "lens_blades" with "lens_rotation" in degrees.
                        "projection" may be "orthographic", with "height" in
                        metres, or "panorama", all around. A file ending in
                        .json works too. Default: the model's first camera, or
                        one that frames it.

RENDERING
${flagsHelp({ biased: false })}
      --samples-from N  Number of the first sample, default 0: a render with
                        --samples-from 100 continues another with 100 samples.
                        See glanz merge.

BIASED OPTIONS
  These give up some light, or blur it, for less noise or time; all are off by
  default.
${flagsHelp({ biased: true })}

MODEL
      --scene SCENE     Which scene of the file, by name or number (from 0).
      --animation NAME  Pose the model by this animation, by name or number, ...
      --time S          ... as it is after S seconds. Default: at rest, or the
                        first animation where --time is given.
      --variant NAME    Look of KHR_materials_variants, by name or number; "all"
                        for each. May be given several times.

MANY IMAGES
  Each variant is rendered from each view; what is the same stays on the GPU.
      --view VIEW       front, back, left, right, top, bottom, front-right,
                        front-left, back-right, back-left, iso; or an azimuth
                        and an elevation in degrees, "30,20"; or whatever
                        --camera takes. May be given several times.
      --turntable N     N views around the model, always from the same distance,
                        turntable-000 and so on,
      --elevation D     ... from D degrees above. Default 20.
      --output FILE     {model}, {variant} and {view} in the name stand for what
                        they say. Names that would be the same get
                        -{variant}-{view} at their ends.
      --batch FILE      Images from a file. JSON: a list of objects whose keys
                        are the names of these options and "model", or
                        { "defaults": {...}, "images": [...] }. CSV: a line of
                        names, then one for each image. What an image does
                        not say the command line does. Paths are relative to the
                        file.
      --resume          Leave out images that an earlier run has finished, if
                        neither options nor files have changed since. A journal
                        beside the images, .glanz-journal.jsonl, knows.
      --checkpoint FILE Keep the samples in FILE while rendering, at most every
                        30 seconds, and when it is interrupted. The same
                        command continues from there; --samples may be raised. A
                        file that belongs to another image is refused. Deleted
                        when the image is written. May hold {model}, {variant}
                        and {view}.
      --gpu NAME        Given several times, or "all", each GPU takes the next
                        image when it is done with one. For several GPUs of
                        one name there is glanz farm task. A GPU that cannot
                        recover leaves its image, with the samples so far, to
                        the rest.
      --output-root DIR Let the batch file write below this folder. Default: the
                        folder that the batch file is in.
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
      --list-gpus       List what could render, and exit.
      --gpu NAME        Use the GPU whose name contains NAME; "software" for the
                        processor.
      --json            Print one JSON object on stdout: files, samples,
                        timings, statistics, adapter; or the error. Of
                        many: { ok, images: [...], total, skipped, failed }.
  -q, --quiet           No progress, no summary.
  -h, --help            This page.
  -V, --version         The version.

EXIT STATUS
  0 done · 1 rendering failed · 2 wrong usage · 3 a file cannot be read or is
  broken · 4 a file cannot be written · 5 no usable GPU, or it was lost ·
  70 a fault of glanz · 130 ended by Ctrl-C after writing what there was (143 by
  SIGTERM, 129 by SIGHUP)

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

/** The page, or what a command of its own takes. */
export function helpOf(topic: string | undefined): string {
  const section =
    topic !== undefined && Object.hasOwn(COMMANDS, topic) ? COMMANDS[topic as keyof typeof COMMANDS] : undefined;
  if (section === undefined) return HELP;
  return `${section}
      --json            Print one JSON object on stdout; or the error.
  -q, --quiet           No progress, no summary.

EXIT STATUS
${/EXIT STATUS\n([\s\S]*?)\n\n/.exec(HELP)?.[1] ?? ''}

  glanz --help is the whole manual.
`;
}
