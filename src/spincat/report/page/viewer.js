'use strict';
// An object in 3D, turned by mouse, touch and arrow keys. One picture a page: browsers allow few.
// Drawn by three.js r111, copyright 2010-2019 three.js authors, MIT licence (opensource.org/licenses/MIT).

function bytesOf(text) {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
const shortsOf = (text) => new Int16Array(bytesOf(text).buffer);
const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
// Shares and normals: 32767 is 1. Places: it is 2.
const sharesOf = (text) => Float32Array.from(shortsOf(text), (value) => value / 32767);
const placesOf = (text) => Float32Array.from(shortsOf(text), (value) => value / 16383.5);

// A part of the page's data, read when it is first wanted.
const readPart = (() => {
  const parts = new Map();
  return (id) => {
    if (!parts.has(id)) parts.set(id, JSON.parse(document.getElementById(id).textContent));
    return parts.get(id);
  };
})();

function hasWebGL() {
  const canvas = document.createElement('canvas');
  return Boolean(canvas.getContext('webgl') || canvas.getContext('experimental-webgl'));
}

const styleOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
function themeColour(name) {
  const value = styleOf(name);
  return new THREE.Color(value.startsWith('#') ? value : 'rgb(' + value.split(' ').join(',') + ')');
}

// Where the camera stands before anybody turns the object: above, a little to the right of the front.
const firstView = { x: [0.41, 0.57, 0.71], y: [0.57, 0.41, 0.71], z: [0.57, -0.71, 0.41] };

// glTF says that y points up, and OBJ files mostly have it so; of the others z is the best guess.
const usualUp = (file) => /\.(obj|gltf|glb)$/i.test(file) ? 'y' : 'z';

class Viewer {
  // `up`: the axis of all objects' files that points up on the screen, or 'none': as usual for the file, until somebody
  // chooses.
  constructor(up) {
    this.up = firstView[up] ? up : 'z';
    this.upIsKnown = Boolean(firstView[up]);
    this.host = el('div', { class: 'viewer', id: 'viewer', tabindex: '0', role: 'img', 'aria-label': 'the object in 3D; arrow keys turn it' });
    this.layers = [];
    if (!hasWebGL()) {
      this.host.append(el('p', { class: 'soft hint' }, 'This browser shows no 3D pictures (WebGL is off).'));
      return;
    }
    this.scene = new THREE.Scene();
    this.sky = new THREE.HemisphereLight(0xffffff, 0xa4a9b2, 0.9);
    this.scene.add(this.sky);
    this.camera = new THREE.PerspectiveCamera(35, 4 / 3, 0.1, 50);
    const lamp = new THREE.DirectionalLight(0xffffff, 0.45);
    lamp.position.set(-0.6, 0.8, 1);
    this.camera.add(lamp);
    this.scene.add(this.camera);
    this.renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.host.append(this.renderer.domElement);
    this.setUp(this.up);
    this.host.addEventListener('keydown', (event) => this.turnByKey(event));
    document.addEventListener('theme', () => { if (this.show) this.show(); });
    new ResizeObserver(() => this.resize()).observe(this.host);
  }

  // OrbitControls takes the camera's up axis once: a new axis asks for new ones.
  setUp(axis) {
    this.up = axis;
    if (this.controls) this.controls.dispose();
    this.camera.up.set(Number(axis === 'x'), Number(axis === 'y'), Number(axis === 'z'));
    this.sky.position.copy(this.camera.up);
    this.camera.position.fromArray(firstView[axis]).setLength(3.8);
    this.camera.lookAt(0, 0, 0);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableKeys = false;
    this.controls.enablePan = false;
    this.controls.minDistance = 1.3;
    this.controls.maxDistance = 8;
    this.controls.addEventListener('change', () => this.draw());
    this.controls.update();
  }

  // Files do not say which axis points up: whoever looks at them does.
  upChoice() {
    const choice = el('select', { id: 'up', onchange: () => { this.upIsKnown = true; if (this.scene) { this.setUp(choice.value); this.draw(); } } },
      ...Object.keys(firstView).map((axis) => el('option', { value: axis }, axis)));
    choice.value = this.up;
    this.choice = choice;
    return [el('label', { class: 'layer' }, choice, ' points up'), el('span', { class: 'soft small' }, 'drag to turn, wheel or two fingers to come nearer')];
  }

  // Before another file's object is shown.
  turnUpright(file) {
    if (!this.scene || this.upIsKnown || usualUp(file) === this.up) return;
    this.setUp(usualUp(file));
    this.choice.value = this.up;
  }

  turnByKey(event) {
    const turns = { ArrowLeft: [0.15, 0], ArrowRight: [-0.15, 0], ArrowUp: [0, 0.12], ArrowDown: [0, -0.12] };
    const turn = turns[event.key];
    if (!turn) return;
    event.preventDefault();
    const toY = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
    const at = new THREE.Spherical().setFromVector3(this.camera.position.clone().applyQuaternion(toY));
    at.theta += turn[0];
    at.phi = Math.min(Math.max(at.phi - turn[1], 0.05), Math.PI - 0.05);
    this.camera.position.setFromSpherical(at).applyQuaternion(toY.inverse());
    this.camera.lookAt(0, 0, 0);
    this.controls.update();
    this.draw();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!width || !height) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
    const p = this.camera.position;
    this.host.dataset.view = [p.x, p.y, p.z].map((value) => value.toFixed(3)).join(',');
  }

  clear() {
    for (const layer of this.layers) {
      this.scene.remove(layer);
      layer.geometry.dispose();
      layer.material.dispose();
    }
    this.layers = [];
  }

  add(layer) {
    this.layers.push(layer);
    this.scene.add(layer);
    return layer;
  }

  // A mesh or a cloud. Its surface steps back by as much as it slants over 4 pixels, so that dots do not sink into it. As shape_json of the program gives it.
  addShape(shape, see = 1) {
    const colour = themeColour('--surface');
    if (!shape.triangles) return this.addDots(placesOf(shape.points), null, 2.5, colour);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(placesOf(shape.points), 3));
    geometry.setIndex(new THREE.BufferAttribute(new Uint16Array(bytesOf(shape.triangles).buffer), 1));
    return this.add(new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ color: colour, roughness: 0.85, flatShading: true,
      side: THREE.DoubleSide, transparent: see < 1, opacity: see, depthWrite: see === 1, polygonOffset: true, polygonOffsetFactor: 4, polygonOffsetUnits: 4 })));
  }

  // Points as dots of `size` pixels, of one colour or of `colours` (3 numbers each).
  addDots(places, colours, size, colour) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
    if (colours) geometry.setAttribute('color', new THREE.BufferAttribute(colours, 3));
    return this.add(new THREE.Points(geometry, new THREE.PointsMaterial({ size: size * Math.min(devicePixelRatio, 2), sizeAttenuation: false,
      color: colours ? 0xffffff : colour, vertexColors: colours ? THREE.VertexColors : THREE.NoColors, map: roundDot(), alphaTest: 0.5 })));
  }

  // Triangles that stand out: filled, and with their edges, so that those without area show, too.
  addTriangles(corners, colour) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    this.add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: colour, side: THREE.DoubleSide, transparent: true, opacity: 0.75 })));
    const edges = new Float32Array(2 * corners.length);
    for (let t = 0; t < corners.length; t += 9) {
      [0, 3, 3, 6, 6, 0].forEach((from, k) => edges.set(corners.subarray(t + from, t + from + 3), 2 * t + 3 * k));
    }
    const lines = new THREE.BufferGeometry();
    lines.setAttribute('position', new THREE.BufferAttribute(edges, 3));
    this.add(new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ color: colour })));
  }

  // Short lines from points along their normals.
  addNormals(places, normals, length, colour) {
    const ends = new Float32Array(2 * places.length);
    for (let i = 0; i < places.length; i += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        ends[2 * i + axis] = places[i + axis];
        ends[2 * i + 3 + axis] = places[i + axis] + length * normals[i + axis];
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(ends, 3));
    return this.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: colour })));
  }
}

let dotTexture = null;
function roundDot() {
  if (!dotTexture) {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 32;
    const pen = canvas.getContext('2d');
    pen.fillStyle = '#fff';
    pen.arc(16, 16, 15, 0, 2 * Math.PI);
    pen.fill();
    dotTexture = new THREE.CanvasTexture(canvas);
  }
  return dotTexture;
}
