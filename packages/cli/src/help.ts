/** The manual page. */
export const HELP = `NAME
  glanz - path-trace glTF models to pictures, with or without a GPU

SYNOPSIS
  glanz render MODEL [-o FILE]... [--env FILE] [--size WxH] [--samples N] [...]
  glanz convert PART [-o FILE.glb] [--lod N] [--materials FILE] [--strip] [...]
  glanz --list-gpus
  glanz --help | --version

DESCRIPTION
  Renders a glTF 2.0 model (.glb or .gltf), an .obj with its .mtl, or an .stl,
  and writes the picture in each format asked for. A model without a camera is
  framed from the front right, a little from above; without --env it stands in
  a neutral photo studio. Uses the best GPU there is, or the processor if there
  is none.

  Progress goes to stderr, nothing but --json goes to stdout. Ctrl-C writes what
  has been accumulated so far; a second Ctrl-C ends at once.

PICTURE
  -o, --output FILE     Where to write; the ending decides the format. May be
                        given several times. Default: the model's name with
                        .png, in the current folder.
                          .png  sRGB, tone-mapped, 8 or 16 bits
                          .exr  linear, with the layers albedo, normal, depth,
                                position, variance, objectId, materialId and
                                one for each light group; half or 32-bit floats
                          .hdr  linear, Radiance RGBE
      --size WxH        Pixels. Default 1024x768.
      --bits N          8 or 16 for .png (default 8), 16 or 32 for .exr
                        (default 16).
      --transparent     Leave the background out: alpha is the coverage.
      --catcher PART    Show of this part, a floor say, only the shadows and the
                        light that the others throw on it. May be given
                        several times.
      --exposure EV     Brighten (or darken) by stops, .png only. Default 0.
                        Or as a camera does, for scenes in cd/m2:
                        f/8,1/125,iso200.
      --tonemap NAME    neutral, aces, agx, reinhard or linear, .png only.
                        Default neutral: base colours stay what they are.

LIGHT AND VIEW
      --env FILE        Surroundings: a lat-long .hdr or .exr, "studio" (default
                        unless the model brings its own) or "none".
      --env-rotation D  Turn them about the vertical axis by D degrees,
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

      --light-groups M  Keep lights apart as layers of .exr: "each" light,
                        glowing material and the surroundings, those "named"
                        by the model (default), or "off".

QUALITY
      --samples N       Paths per pixel. Default 256.
      --noise F         Sample where there is noise until the standard error is
                        F of the brightness: 0.05 is a preview, 0.01 hardly to
                        be seen. --samples is the most then, 65536 by default.
      --depth N         Most edges of a path from the camera to a light: 1 shows
                        only what glows, 2 adds direct light. Default 8.
      --filter NAME     How samples make up a pixel: box (default), gaussian or
                        blackman-harris; NAME:RADIUS in pixels for another
                        width (default 1.5 for the last two).
      --seed N          Other noise, same picture; the same seed gives the same
                        picture on the same device. Default 0.

SHORTCUTS
  All of these give up some truth for less noise or time; by default none does.
      --max-bounces L   Most bounces of a kind: diffuse=2,specular=4; also
                        transmission and volume.
      --regularization F
                        Widen sharp lobes after wide bounces, 0 to 1: 0.25 takes
                        most fireflies away.
      --clamp-indirect N
                        Cut indirect light brighter than N.
      --no-caustics     No light on matte things by way of mirrors and glass.

CONVERTING
  glanz convert turns a CAD file (.step, .iges, .brep) into .glb. It needs the
  package @glanz/cad.
  -o, --output FILE     Default: the model's name with .glb, in this folder.
      --lod N           Levels of detail, each of a quarter of the triangles:
                        part.glb, part.lod1.glb, part.lod2.glb. Default 1.
      --materials FILE  JSON that translates names and colours of parts to
                        materials; see the package.
      --strip           Leave out names and metadata.
      --tolerance MM    How far triangles may lie from the surface, millimetres.
                        Default: a thousandth of the model's size.

MACHINE
      --list-gpus       List what could render, and exit.
      --gpu NAME        Use the GPU whose name contains NAME; "software" for the
                        processor.
      --json            Print one JSON object on stdout: files, samples,
                        timings, statistics, adapter; or the error.
  -q, --quiet           No progress, no summary.
  -h, --help            This page.
  -V, --version         The version.

EXIT STATUS
  0 done · 1 rendering failed · 2 wrong usage · 3 a file cannot be read or is
  broken · 4 a file cannot be written · 5 no usable GPU · 70 a fault of glanz ·
  130 ended by Ctrl-C after writing what there was (143 by SIGTERM)

EXAMPLES
  glanz render helmet.glb
  glanz render helmet.glb -o helmet.png -o helmet.exr --samples 1024
  glanz render chair.gltf --env studio.hdr --env-rotation 90 --exposure 0.5
  glanz render part.glb --transparent --size 512x512 -o part.png --json
  glanz convert part.step -o part.glb --lod 3 --materials map.json --strip
  glanz render room.glb --camera '{"position":[0,1.6,3],"target":[0,1.2,0]}'
`;
