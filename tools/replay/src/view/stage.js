// The stage: camera, renderer, and all objects in the model frame. Gravity points down on the screen, so that
// a tilted slope looks tilted.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { frameBeside } from "./framing.js";

const views = { // direction from the middle to the camera; z is up, the toe on the left
  iso: [-0.55, -0.95, 0.5], front: [0.0001, -1, 0.02], toe: [-1, -0.0001, 0.1], top: [0, -0.02, 1],
};

export class Stage {
  constructor(canvas, onChange, onTaken) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.autoClear = false;
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.camera.up.set(0, 0, 1);
    this.model = new THREE.Group(); // model frame
    this.over = new THREE.Group(); // the same frame, drawn over all the rest
    this.scene = new THREE.Scene().add(this.model);
    this.overScene = new THREE.Scene().add(this.over);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", onTaken);
    this.middle = [0, 0]; // where on the canvas the camera looks to, from its middle [px]
  }

  setTilt(tilt) {
    for (const group of [this.model, this.over]) group.rotation.y = -tilt, group.updateMatrixWorld(true);
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.setMiddle(...this.middle);
  }

  setMiddle(x, y) {
    const { x: width, y: height } = this.renderer.getSize(new THREE.Vector2());
    this.middle = [x, y];
    this.camera.setViewOffset(width, Math.max(1, height), -x, -y, width, Math.max(1, height)); // sets the aspect, too
  }

  /**
   * Looks at points of the model frame from one of the named views, so that all are seen beside what stands over the scene
   * (rectangles of the canvas). The oblique view is turned so that what goes in the direction `heading` (from east towards
   * north, in radians) comes towards the reader as a slope's toe does.
   */
  look(view, points, overlays, heading = Math.PI) {
    const up = new THREE.Vector3(0, 0, 1);
    const towards = new THREE.Vector3(...views[view]).normalize().applyAxisAngle(up, view === "iso" ? heading - Math.PI : 0);
    const right = up.clone().cross(towards).normalize(), upwards = towards.clone().cross(right);
    const placed = points.map((point) => new THREE.Vector3(...point).applyMatrix4(this.model.matrixWorld));
    const sphere = new THREE.Box3().setFromPoints(placed).getBoundingSphere(new THREE.Sphere());
    const seen = placed.map((point) => point.sub(sphere.center)).map((p) => [p.dot(right), p.dot(upwards), p.dot(towards)]);
    const { x: width, y: height } = this.renderer.getSize(new THREE.Vector2());
    const pixel = (2 * Math.tan((Math.PI / 360) * this.camera.fov)) / Math.max(1, height);
    const { distance, shift, middle } = frameBeside(seen, overlays, width, height, pixel);
    this.controls.target.copy(sphere.center).addScaledVector(right, shift[0]).addScaledVector(upwards, shift[1]);
    this.camera.position.copy(this.controls.target).addScaledVector(towards, distance);
    this.camera.near = distance / 100, (this.camera.far = distance * 100);
    this.setMiddle(middle[0] - width / 2, middle[1] - height / 2);
    this.controls.minDistance = sphere.radius / 50, (this.controls.maxDistance = Math.max(sphere.radius * 30, 2 * distance));
    this.controls.update();
  }

  render() {
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    this.renderer.clearDepth();
    this.renderer.render(this.overScene, this.camera);
  }

  /** Ray through a point of the canvas (in CSS pixels from its corner), in the model frame. */
  rayAt(x, y) {
    const size = this.renderer.getSize(new THREE.Vector2());
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * x) / size.x - 1, 1 - (2 * y) / size.y), this.camera);
    const back = this.model.matrixWorld.clone().invert();
    const local = ray.ray.clone().applyMatrix4(back);
    return { origin: local.origin.toArray(), direction: local.direction.normalize().toArray() };
  }

  /** Place of a model point on the canvas in CSS pixels, or null when it is behind the camera. */
  screenOf(point) {
    const size = this.renderer.getSize(new THREE.Vector2());
    const at = new THREE.Vector3(...point).applyMatrix4(this.model.matrixWorld).project(this.camera);
    return at.z > 1 ? null : { x: ((at.x + 1) / 2) * size.x, y: ((1 - at.y) / 2) * size.y };
  }

  /** Size of a CSS pixel at the middle of the view [m]. */
  metresPerPixel() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const height = this.renderer.getSize(new THREE.Vector2()).y;
    return (2 * distance * Math.tan((this.camera.fov * Math.PI) / 360)) / Math.max(1, height);
  }

  /** Where the camera looks to: east, north, up, as gravity has them. */
  direction() {
    return this.camera.getWorldDirection(new THREE.Vector3()).toArray();
  }

  /** Level directions to the north and to the east on the screen (right, up, towards). */
  compass() {
    const seen = (v) => new THREE.Vector3(...v).transformDirection(this.camera.matrixWorldInverse).toArray();
    return { north: seen([0, 1, 0]), east: seen([1, 0, 0]) };
  }

  /** Directions of the model's axes and of gravity on the screen (right, up). */
  axes(tilt) {
    const turn = this.camera.matrixWorldInverse;
    const seen = (v) => new THREE.Vector3(...v).transformDirection(turn).toArray();
    const c = Math.cos(tilt), s = Math.sin(tilt);
    return { x: seen([c, 0, s]), y: seen([0, 1, 0]), z: seen([-s, 0, c]), g: seen([0, 0, -1]) };
  }
}
