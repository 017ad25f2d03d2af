# Writes the files of the tests with OpenUSD: pip install usd-core pillow; python make-files.py
import json
import os
import random
import shutil
import tempfile

from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, UsdUtils, Vt

out = os.path.dirname(os.path.abspath(__file__))
work = tempfile.mkdtemp()
os.chdir(work)
image = Image.new("RGBA", (2, 2))
image.putdata([(255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 128)])
os.mkdir("textures")
image.save("textures/color.png")


def build(path):
    stage = Usd.Stage.CreateNew(path)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    root = UsdGeom.Xform.Define(stage, "/Root")
    stage.SetDefaultPrim(root.GetPrim())
    root.AddTranslateOp().Set(Gf.Vec3d(100, 0, 0))
    arm = UsdGeom.Xform.Define(stage, "/Root/Arm")
    arm.AddTranslateOp().Set(Gf.Vec3d(0, 0, 10))
    arm.AddRotateXYZOp().Set(Gf.Vec3f(10, 20, 30))
    arm.AddScaleOp().Set(Gf.Vec3f(2, 1, 1))

    def material(name):
        made = UsdShade.Material.Define(stage, f"/Root/Materials/{name}")
        shader = UsdShade.Shader.Define(stage, f"/Root/Materials/{name}/Surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        made.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        return made, shader

    painted, shader = material("Painted")
    shader.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(0.25)
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.4)
    shader.CreateInput("clearcoat", Sdf.ValueTypeNames.Float).Set(0.5)
    shader.CreateInput("ior", Sdf.ValueTypeNames.Float).Set(1.4)
    shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0, 0.5, 2))
    reader = UsdShade.Shader.Define(stage, "/Root/Materials/Painted/Reader")
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    move = UsdShade.Shader.Define(stage, "/Root/Materials/Painted/Move")
    move.CreateIdAttr("UsdTransform2d")
    move.CreateInput("in", Sdf.ValueTypeNames.Float2).ConnectToSource(reader.ConnectableAPI(), "result")
    move.CreateInput("scale", Sdf.ValueTypeNames.Float2).Set(Gf.Vec2f(2, 3))
    move.CreateInput("rotation", Sdf.ValueTypeNames.Float).Set(90)
    move.CreateInput("translation", Sdf.ValueTypeNames.Float2).Set(Gf.Vec2f(0.25, 0.5))
    texture = UsdShade.Shader.Define(stage, "/Root/Materials/Painted/Texture")
    texture.CreateIdAttr("UsdUVTexture")
    texture.CreateInput("file", Sdf.ValueTypeNames.Asset).Set("textures/color.png")
    texture.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(move.ConnectableAPI(), "result")
    texture.CreateInput("wrapS", Sdf.ValueTypeNames.Token).Set("clamp")
    texture.CreateInput("wrapT", Sdf.ValueTypeNames.Token).Set("mirror")
    texture.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(0.5, 0.5, 0.5, 1))
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(texture.ConnectableAPI(), "rgb")
    shader.CreateInput("opacity", Sdf.ValueTypeNames.Float).ConnectToSource(texture.ConnectableAPI(), "a")
    shader.CreateInput("opacityThreshold", Sdf.ValueTypeNames.Float).Set(0.75)

    shiny, shader = material("Shiny")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.1, 0.2, 0.3))
    shader.CreateInput("useSpecularWorkflow", Sdf.ValueTypeNames.Int).Set(1)
    shader.CreateInput("specularColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.08, 0.04, 0.02))
    shader.CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(0.25)

    quad = UsdGeom.Mesh.Define(stage, "/Root/Arm/Quads")
    quad.CreateSubdivisionSchemeAttr("none")
    quad.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)])
    quad.CreateFaceVertexCountsAttr([4, 4])
    quad.CreateFaceVertexIndicesAttr([0, 1, 4, 3, 1, 2, 5, 4])
    quad.CreateNormalsAttr([(0, 0, 1)] * 6)
    quad.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    st = UsdGeom.PrimvarsAPI(quad).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
    st.Set([(0, 0), (0.5, 0), (0.5, 1), (0, 1), (1, 0), (1, 1)])
    st.SetIndices(Vt.IntArray([0, 1, 2, 3, 1, 4, 5, 2]))
    UsdShade.MaterialBindingAPI.Apply(quad.GetPrim()).Bind(painted)
    subset = UsdShade.MaterialBindingAPI(quad).CreateMaterialBindSubset("right", Vt.IntArray([1]))
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(shiny)

    left = UsdGeom.Mesh.Define(stage, "/Root/LeftHanded")
    left.CreateOrientationAttr(UsdGeom.Tokens.leftHanded)
    left.CreateSubdivisionSchemeAttr("none")
    left.CreateDoubleSidedAttr(True)
    left.CreatePointsAttr([(0, 0, 0), (0, 1, 0), (1, 0, 0)])
    left.CreateFaceVertexCountsAttr([3])
    left.CreateFaceVertexIndicesAttr([0, 1, 2])
    left.CreateDisplayColorAttr([(0.7, 0.6, 0.5)])

    hidden = UsdGeom.Mesh.Define(stage, "/Root/Hidden")
    hidden.CreatePointsAttr([(0, 0, 0), (0, 1, 0), (1, 0, 0)])
    hidden.CreateFaceVertexCountsAttr([3])
    hidden.CreateFaceVertexIndicesAttr([0, 1, 2])
    hidden.CreateVisibilityAttr(UsdGeom.Tokens.invisible)
    UsdGeom.Camera.Define(stage, "/Root/Camera")
    stage.GetRootLayer().Save()


build("model.usdc")
build("model.usda")
UsdUtils.CreateNewUsdzPackage("model.usdc", os.path.join(out, "model.usdz"))
shutil.copy("model.usda", os.path.join(out, "model.usda"))

# What OpenUSD says of it: corners of faces in the stage's world space, in its units and axes.
stage = Usd.Stage.Open(os.path.join(out, "model.usdz"))
cache = UsdGeom.XformCache()
said = {}
for prim in stage.Traverse():
    if prim.IsA(UsdGeom.Mesh):
        mesh = UsdGeom.Mesh(prim)
        world = cache.GetLocalToWorldTransform(prim)
        points = mesh.GetPointsAttr().Get()
        corners = mesh.GetFaceVertexIndicesAttr().Get()
        said[prim.GetName()] = [list(world.Transform(Gf.Vec3d(points[i]))) for i in corners]

# A layer with a value of every type, small and large, and what OpenUSD reads from it.
T = Sdf.ValueTypeNames
random.seed(7)
noise = [random.uniform(-5, 5) for _ in range(64)]
wide = [random.randrange(-(2**40), 2**40) for _ in range(40)]
values = {
    "bool": (T.Bool, True),
    "uchar": (T.UChar, 200),
    "int": (T.Int, -5),
    "uint": (T.UInt, 5),
    "int64": (T.Int64, 2**40),
    "int64Small": (T.Int64, -3),
    "half": (T.Half, 0.25),
    "float": (T.Float, 0.1),
    "double": (T.Double, 0.1),
    "doubleSmall": (T.Double, 2.5),
    "string": (T.String, "a text"),
    "token": (T.Token, "aToken"),
    "asset": (T.Asset, Sdf.AssetPath("some/file.png")),
    "matrix2": (T.Matrix2d, Gf.Matrix2d(1, 2, 3, 4.5)),
    "matrix3": (T.Matrix3d, Gf.Matrix3d(1, 2, 3, 4, 5, 6, 7, 8, 9.5)),
    "matrix4": (T.Matrix4d, Gf.Matrix4d(*[k + 0.5 for k in range(16)])),
    "matrixDiagonal": (T.Matrix4d, Gf.Matrix4d(2, 0, 0, 0, 0, -3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1)),
    "quath": (T.Quath, Gf.Quath(0.5, Gf.Vec3h(1, 2, 3))),
    "quatf": (T.Quatf, Gf.Quatf(0.5, Gf.Vec3f(1, 2, 3))),
    "quatd": (T.Quatd, Gf.Quatd(0.5, Gf.Vec3d(1, 2, 3))),
    "vec2": (T.Float2, Gf.Vec2f(0.5, 1.5)),
    "vec2Small": (T.Double2, Gf.Vec2d(-7, 8)),
    "vec3": (T.Double3, Gf.Vec3d(0.1, 100000, -3)),
    "vec3Small": (T.Double3, Gf.Vec3d(1, -2, 100)),
    "vec3i": (T.Int3, Gf.Vec3i(1000, -2, 3)),
    "vec3h": (T.Half3, Gf.Vec3h(0.5, -2, 65504)),
    "vec4": (T.Float4, Gf.Vec4f(0.5, 1, 2, 3)),
    "color": (T.Color3f, Gf.Vec3f(0.25, 0.5, 1)),
    "empty": (T.IntArray, Vt.IntArray()),
    "ints": (T.IntArray, Vt.IntArray([3, 1, 2])),
    "intsLong": (T.IntArray, Vt.IntArray([k * k - 70000 * (k % 3) for k in range(300)])),
    "intsWide": (T.Int64Array, Vt.Int64Array(wide)),
    "floats": (T.FloatArray, Vt.FloatArray(noise)),
    "floatsWhole": (T.FloatArray, Vt.FloatArray([float(k * 7 - 50) for k in range(64)])),
    "floatsFew": (T.FloatArray, Vt.FloatArray([noise[k % 5] for k in range(400)])),
    "doublesFew": (T.DoubleArray, Vt.DoubleArray([noise[k % 5] for k in range(400)])),
    "halves": (T.HalfArray, Vt.HalfArray([0.5, -1, 6.1e-5, 1e-7])),
    "points": (T.Point3fArray, Vt.Vec3fArray([(a, b, c) for a, b, c in zip(noise, noise[1:], noise[2:])])),
    "texels": (T.TexCoord2fArray, Vt.Vec2fArray([(a, b) for a, b in zip(noise, noise[1:])])),
    "tokens": (T.TokenArray, Vt.TokenArray(["one", "two", "one"])),
    "strings": (T.StringArray, Vt.StringArray(["one", "", "three"])),
}


def plain(value):
    if isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, Sdf.AssetPath):
        return value.path
    if hasattr(value, "imaginary"):
        return [*value.imaginary, value.real]
    flat = []
    for item in value:
        inner = plain(item)
        flat.extend(inner if isinstance(inner, list) else [inner])
    return flat


expected = {}
for extension in ["usdc", "usda"]:
    stage = Usd.Stage.CreateNew(f"values.{extension}")
    prim = stage.DefinePrim("/Values", "Scope")
    for name, (kind, value) in values.items():
        prim.CreateAttribute(name, kind).Set(value)
    sampled = prim.CreateAttribute("sampled", T.Float3)
    sampled.Set(Gf.Vec3f(1.5, 2, 3), 1)
    sampled.Set(Gf.Vec3f(4, 5, 6), 2)
    target = stage.OverridePrim("/Values/Over")
    prim.CreateRelationship("both").SetTargets(["/Values/Over", "/Values"])
    prim.CreateAttribute("connected", T.Float).AddConnection("/Values.float")
    stage.GetRootLayer().Save()
    shutil.copy(f"values.{extension}", out)
    for name in values:
        expected[name] = plain(prim.GetAttribute(name).Get())
json.dump({"world": said, "values": expected}, open(os.path.join(out, "said.json"), "w"))
