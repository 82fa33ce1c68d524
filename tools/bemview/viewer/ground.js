// Planes: a sheet that fades out, with lines at round distances, and the shadows that fall on it.
import { Color, DoubleSide, FrontSide, Group, Mesh, PlaneGeometry, Quaternion, ShaderMaterial, ShadowMaterial, Vector3 } from "three";

const VERTEX = `
  varying vec2 place;
  void main() {
    place = position.xy;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

const FRAGMENT = `
  uniform vec3 sheet, line;
  uniform float cell, reach, sheetOpacity, lineOpacity;
  varying vec2 place;
  float lines(float width) {
    vec2 at = place / width;
    vec2 step = fwidth(at);
    vec2 near = abs(fract(at - 0.5) - 0.5) / max(step, vec2(1e-6));
    return (1.0 - min(min(near.x, near.y), 1.0)) * clamp(1.5 - 2.5 * max(step.x, step.y), 0.0, 1.0);
  }
  void main() {
    float fade = 1.0 - smoothstep(0.25, 1.0, length(place) / reach);
    float strength = max(lines(cell) * 0.45, lines(5.0 * cell)) * lineOpacity;
    gl_FragColor = vec4(mix(sheet, line, strength), fade * max(sheetOpacity, strength));
    #include <colorspace_fragment>
  }`;

export class Ground extends Group {
  /** `reach` [m]: where it has faded out; `cell`: distance of lines. */
  constructor(point, normal, reach, cell, solid) {
    super();
    this.geometry = new PlaneGeometry(2 * reach, 2 * reach);
    this.sheet = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      side: solid ? DoubleSide : FrontSide,
      uniforms: {
        sheet: { value: new Color() },
        line: { value: new Color() },
        cell: { value: cell },
        reach: { value: reach },
        sheetOpacity: { value: 0 },
        lineOpacity: { value: 0 },
      },
    });
    this.shadow = new ShadowMaterial({ transparent: true, depthWrite: false });
    const sheet = new Mesh(this.geometry, this.sheet);
    const shadow = new Mesh(this.geometry, this.shadow);
    sheet.renderOrder = -2;
    shadow.renderOrder = -1;
    shadow.receiveShadow = true;
    this.add(sheet, shadow);
    this.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), normal));
    this.position.copy(point);
  }

  setTheme(theme) {
    const { uniforms } = this.sheet;
    uniforms.sheet.value.set(theme.sheet);
    uniforms.line.value.set(theme.line);
    uniforms.sheetOpacity.value = theme.sheetOpacity;
    uniforms.lineOpacity.value = theme.lineOpacity;
    this.shadow.color.set(theme.shadow);
    this.shadow.opacity = theme.shadowOpacity;
  }
}
