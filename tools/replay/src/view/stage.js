// The stage: camera, renderer, and everything that stands in the model frame. Gravity points down on the screen, so that
// a tilted slope looks tilted.

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const views = { // direction from the middle to the camera; z is up, the toe on the left
  iso: [-0.55, -0.95, 0.5], front: [0.0001, -1, 0.02], toe: [-1, -0.0001, 0.1], top: [0, -0.02, 1],
};

export class Stage {
  constructor(canvas, onChange) {
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
    this.sphere = new THREE.Sphere();
  }

  setTilt(tilt) {
    for (const group of [this.model, this.over]) group.rotation.y = -tilt, group.updateMatrixWorld(true);
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
  }

  /**
   * Looks at a sphere (centre in the model frame) from one of the named views; the oblique one is turned so that what goes
   * in the direction `heading` (from east towards north, in radians) comes towards the reader as a slope's toe does.
   */
  look(view, centre, radius, heading = Math.PI) {
    const middle = new THREE.Vector3(...centre).applyMatrix4(this.model.matrixWorld);
    const angle = (Math.PI / 180) * this.camera.fov;
    const narrow = Math.min(angle, 2 * Math.atan(Math.tan(angle / 2) * this.camera.aspect));
    const distance = radius / Math.sin(narrow / 2);
    this.camera.position.copy(middle).addScaledVector(new THREE.Vector3(...views[view]).normalize()
      .applyAxisAngle(new THREE.Vector3(0, 0, 1), view === "iso" ? heading - Math.PI : 0), distance);
    this.camera.near = distance / 100, (this.camera.far = distance * 100);
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(middle);
    this.controls.minDistance = radius / 50, (this.controls.maxDistance = radius * 30);
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
