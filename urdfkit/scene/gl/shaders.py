"""The shaders: the light of `scene.rays.shading.camera_picture`, per face where that is exact, else per pixel.

All coordinates are in the camera's frame: x forward, y left, z up.
"""

from dataclasses import dataclass

from urdfkit.scene.rays.shading.direct_lighting import DIRECTIONAL, SPOT
from urdfkit.scene.rays.shading.surface_attributes import FINEST

STILL = ("s",)
BOTH = ("s", "m")
"""Names of shadow maps: of static shapes, of moving shapes."""

COLOR = ("color",)
DEEP = ("depth", "shape")
ALL = (*COLOR, *DEEP)
"""Output buffers: colours, distances along the camera's axis, indices of shapes."""

Lamps = tuple[tuple[int, bool], ...]
"""Kind of each light, and whether it casts shadows."""


@dataclass(frozen=True)
class ShaderKind:
    """Features of a pair of shaders.

    Attributes:
        lamps: the lights.
        flat: the surface has one normal per triangle.
        plain: the surface has one colour per triangle.
        textured: a texture gives the colour.
        wanted: the output buffers.
        clear: parts of the surface may be fully transparent, and have no depth there.
        exact: surfaces are clipped by their distance from the camera, as rays are.
        maps: shadow maps per light that casts shadows: of static and of moving shapes.
        glossy: the surface has specular reflections.
    """

    lamps: Lamps
    flat: bool
    plain: bool
    textured: bool
    wanted: tuple[str, ...]
    clear: bool
    exact: bool
    maps: tuple[str, ...] = STILL
    glossy: bool = False

    @property
    def colors(self) -> bool:
        """Whether colours are drawn."""
        return "color" in self.wanted

    @property
    def deep(self) -> bool:
        """Whether depths and shapes are drawn."""
        return "depth" in self.wanted

    @property
    def early(self) -> bool:
        """Whether the light is constant on a triangle, except for shadows."""
        return self.flat and not self.glossy and all(kind == DIRECTIONAL for kind, _ in self.lamps)

    @property
    def ready(self) -> bool:
        """Whether the colour is constant as well, so that only shadows are computed per pixel."""
        return self.colors and self.early and self.plain and not self.textured


_OUT = {"color": "vec4", "depth": "float", "shape": "float"}

_DYE = f"""in vec2 v_uv; uniform sampler2D u_texture;
vec4 dyed() {{
    // Quantities that are linear in the image have exact differences: q, and texture coordinates times q.
    float q = 1.0 / v_point.x; vec2 at = v_uv * q, size = vec2(textureSize(u_texture, 0));
    vec2 across = (dFdx(at) - v_uv * dFdx(q)) / q, down = (dFdy(at) - v_uv * dFdy(q)) / q;
    float l = length(across * size), s = length(down * size);
    if (s > l) {{ float r = l; l = s; s = r; across = down; }}
    float count = clamp(ceil(l / max(s, 1.0)), 1.0, {FINEST}.0), level = log2(max(l / count, 1.0));
    vec4 color = vec4(0.0);
    for (float k = 0.5; k < count; k += 1.0)
        color += textureLod(u_texture, v_uv + (k / count - 0.5) * across, level);
    return color / count;
}}"""
"""As `surface_attributes.dye`."""

_GAIN = """
float gain{k}(vec3 n, vec3 p) {{ {body} }}"""

_SUN = "return max(dot(n, u_lamp{k}), 0.0);"

_LAMP = """
    vec3 to = u_lamp{k} - p;
    float r = length(to);
    if (r > u_fall{k}.x || r <= 0.0) return 0.0;
    to /= r;
    float fall = 1.0 / max(u_fall{k}.y + r * (u_fall{k}.z + r * u_fall{k}.w), 1e-9);
    {spot}
    return fall * max(dot(n, to), 0.0);
"""

_SPOT = """
    float along = -dot(to, u_towards{k});
    if (along <= u_cone{k}.y) return 0.0;
    fall *= pow(clamp((along - u_cone{k}.y) / max(u_cone{k}.x - u_cone{k}.y, 1e-9), 0.0, 1.0), u_cone{k}.z);
"""


_SHEEN = """
    if (g{k} > 0.0) {{
        vec3 to{k} = {to};
        sheen += g{k} / dot(n, to{k}) * pow(max(dot(n, normalize(to{k} + eye)), 0.0), u_gloss.a) * u_sheen{k};
    }}
"""
"""As `camera_picture.throw_back`."""


def _lights(lamps: Lamps, maps: tuple[str, ...]) -> str:
    """Return uniforms and one function per light, which computes its gain at a point."""
    lines = ["uniform vec3 u_air;"]
    for k, (kind, shadows) in enumerate(lamps):
        lines.append(f"uniform vec3 u_lamp{k}; uniform vec3 u_glow{k};")
        body = _SUN.format(k=k)
        if kind != DIRECTIONAL:
            lines.append(f"uniform vec4 u_fall{k}; uniform vec3 u_towards{k}; uniform vec3 u_cone{k};")
            body = _LAMP.format(k=k, spot=_SPOT.format(k=k) if kind == SPOT else "")
        lines.append(_GAIN.format(k=k, body=body))
        if shadows:
            lines += [f"uniform mat4 u_shade{k}{m}; uniform float u_lift{k}{m};" for m in maps]
    return "\n".join(lines)


def vertex_shader(kind: ShaderKind) -> str:
    """Return the vertex shader."""
    shaded = [k for k, (_, shadows) in enumerate(kind.lamps) if shadows]
    out, body = [], []
    if kind.colors and kind.early:
        body.append("if (dot(n, q) > 0.0) n = -n;")
        for k in range(len(kind.lamps)):
            out.append("" if kind.ready else f"flat out float v_gain{k};")
            body.append(f"{'float ' if kind.ready else ''}v_gain{k} = gain{k}(n, q);")
        for k in shaded:
            for m in kind.maps:
                out.append(f"out vec3 v_shade{k}{m};")
                body.append(f"v_shade{k}{m} = (u_shade{k}{m} * vec4(q + u_lift{k}{m} * n, 1.0)).xyz;")
    elif kind.colors:
        out.append("out vec3 v_normal;")
        body.append("v_normal = n;")
    if kind.exact or kind.deep or kind.textured or (kind.colors and not kind.early):
        out.append("out vec3 v_point;")
        body.append("v_point = q;")
    if kind.deep:
        out.append("flat out float v_shape;")
        body.append("v_shape = in_shape;")
    out.append("flat out vec4 v_color;" if kind.plain else "out vec4 v_color;")
    body.append("v_color = in_color * in_rgba;")
    if kind.ready:
        body.append("vec3 color = v_color.rgb; v_color.rgb *= u_air;")
        for k, (_, shadows) in enumerate(kind.lamps):
            if shadows:
                out.append(f"flat out vec3 v_lit{k};")
                body.append(f"v_lit{k} = color * v_gain{k} * u_glow{k};")
            else:
                body.append(f"v_color.rgb += color * v_gain{k} * u_glow{k};")
    if kind.textured:
        out.append("out vec2 v_uv;")
        body.append("v_uv = vec2(in_uv.x, 1.0 - in_uv.y);")
    lines = "\n".join(out), "\n    ".join(body)
    return f"""#version 330
in vec3 in_position; in vec3 in_normal; in vec2 in_uv; in vec4 in_color;
in vec4 in_x; in vec4 in_y; in vec4 in_z; in vec3 in_scale; in vec4 in_rgba; in float in_shape;
uniform vec4 u_lens;
invariant gl_Position;
{_lights(kind.lamps, kind.maps) if kind.colors and kind.early else ""}
{lines[0]}
void main() {{
    vec4 p = vec4(in_position * in_scale, 1.0);
    vec3 q = vec3(dot(in_x, p), dot(in_y, p), dot(in_z, p));
    gl_Position = vec4(-q.y * u_lens.x, -q.z * u_lens.y, u_lens.z * q.x + u_lens.w, q.x);
    vec3 m = in_normal / in_scale;
    vec3 n = normalize(vec3(dot(in_x.xyz, m), dot(in_y.xyz, m), dot(in_z.xyz, m)));
    {lines[1]}
}}
"""


def fragment_shader(kind: ShaderKind) -> str:
    """Return the fragment shader."""
    head, body = ["flat in vec4 v_color;" if kind.plain else "in vec4 v_color;"], ["vec4 color = v_color;"]
    if kind.textured:
        head.append(_DYE)
        body.append("color *= dyed();")
    if kind.exact:
        head.append("uniform vec2 u_reach;")
        body.append("float far = length(v_point); if (far < u_reach.x || far > u_reach.y) discard;")
    if kind.exact or kind.deep or kind.textured or not kind.early:
        head.insert(0, "in vec3 v_point;")
    head += [f"layout(location = {k}) out {_OUT[each]} o_{each};" for k, each in enumerate(kind.wanted)]
    if kind.deep:
        head.append("flat in float v_shape;")
        if kind.clear:  # only then, because a shader that may discard prevents the early depth test
            body.append("if (color.a <= 0.0) discard;")
        body.append("o_depth = v_point.x; o_shape = v_shape;")
    if not kind.colors:
        return _fragment(head, body)
    if kind.ready:
        for k, (_, shadows) in enumerate(kind.lamps):
            if shadows:
                head.append(f"flat in vec3 v_lit{k};")
                body.append(f"float g{k} = 1.0;")
                _shade(kind, k, head, body)
                body.append(f"color.rgb += g{k} * v_lit{k};")
        body.append("o_color = vec4(min(color.rgb, 1.0), color.a);")
        return _fragment(head, body)
    head.append(_lights(kind.lamps, kind.maps) if not kind.early else "uniform vec3 u_air;")
    body.append("vec3 light = u_air;")
    if kind.glossy:
        head.append("uniform vec4 u_gloss;")
        body.append("vec3 sheen = vec3(0.0), eye = -normalize(v_point);")
    if not kind.early:
        head.append("in vec3 v_normal;")
        body.append("vec3 n = normalize(v_normal); if (!gl_FrontFacing) n = -n;")
    for k, (_, shadows) in enumerate(kind.lamps):
        if kind.early:
            head.append(f"flat in float v_gain{k}; uniform vec3 u_glow{k};")
            body.append(f"float g{k} = v_gain{k};")
        else:
            body.append(f"float g{k} = gain{k}(n, v_point);")
        if shadows:
            _shade(kind, k, head, body)
        body.append(f"light += g{k} * u_glow{k};")
        if kind.glossy:
            head.append(f"uniform vec3 u_sheen{k};")
            to = f"u_lamp{k}" if kind.lamps[k][0] == DIRECTIONAL else f"normalize(u_lamp{k} - v_point)"
            body.append(_SHEEN.format(k=k, to=to))
    shone = "color.rgb * light + u_gloss.rgb * sheen" if kind.glossy else "color.rgb * light"
    body.append(f"o_color = vec4(min({shone}, 1.0), color.a);")
    return _fragment(head, body)


def _shade(kind: ShaderKind, k: int, head: list[str], body: list[str]) -> None:
    """Add the code that removes a light in its shadows."""
    for m in kind.maps:
        name = f"{k}{m}"
        head.append(f"uniform sampler2DShadow u_map{name};")
        if kind.early:
            head.append(f"in vec3 v_shade{name};")
            body.append(f"vec3 s{name} = v_shade{name};")
        else:
            body.append(f"vec3 s{name} = (u_shade{name} * vec4(v_point + u_lift{name} * n, 1.0)).xyz;")
        body.append(
            f"if (g{k} > 0.0 && all(lessThan(abs(s{name}.xy - 0.5), vec2(0.5)))) "
            f"g{k} *= texture(u_map{name}, vec3(s{name}.xy, min(s{name}.z, 1.0)));"
        )


def _fragment(head: list[str], body: list[str]) -> str:
    lines = "\n".join(head), "\n    ".join(body)
    return f"#version 330\n{lines[0]}\nvoid main() {{\n    {lines[1]}\n}}\n"


SHADOW_VERTEX = """#version 330
in vec3 in_position;
in vec4 in_x; in vec4 in_y; in vec4 in_z; in vec3 in_scale;
uniform mat4 u_light;
void main() {
    vec4 p = vec4(in_position * in_scale, 1.0);
    gl_Position = u_light * vec4(dot(in_x, p), dot(in_y, p), dot(in_z, p), 1.0);
}
"""

SHADOW_FRAGMENT = """#version 330
void main() {}
"""
