// The drawing of the structure moves, turns and changes its mode. Without scripts it stands still, in its first mode.
const FULL_TURN = 2 * Math.PI, PERIOD = 2200; // milliseconds of one oscillation as shown
const still = matchMedia("(prefers-reduced-motion: reduce)");
const place = (value) => value.toFixed(1).replace(/\.0$/, "");

function turned(turn, tilt) {
  const [a, e] = [turn, tilt].map((degrees) => degrees * Math.PI / 180);
  return [
    [Math.cos(a), -Math.sin(a), 0],
    [Math.sin(a) * Math.sin(e), Math.cos(a) * Math.sin(e), Math.cos(e)],
  ];
}

// Coordinates across and upward, one after another, of points whose three coordinates stand one after another.
function projected(points, matrix) {
  const found = new Float64Array(2 * points.length / 3);
  for (let i = 0, k = 0; i < points.length; i += 3) {
    for (const row of matrix) found[k++] = row[0] * points[i] + row[1] * points[i + 1] + row[2] * points[i + 2];
  }
  return found;
}

class Stage {
  constructor(figure) {
    this.figure = figure;
    this.svg = figure.querySelector(".stage");
    this.scene = JSON.parse(this.svg.dataset.scene);
    [, , this.width, this.height] = this.svg.getAttribute("viewBox").split(" ").map(Number);
    this.mode = 0;
    this.phase = 0.25;
    this.playing = false;
    const find = (name) => figure.querySelector(name);
    this.parts = {
      still: find("path.still:not(.dots)"), stillDots: find(".still.dots"), stretch: find(".stretch"), stems: find(".stems"),
      moved: find("path.moved:not(.dots)"), movedDots: find(".moved.dots"), test: find("path.test"), caption: find(".now"),
    };
    this.rings = [...this.svg.querySelectorAll(".ring")];
    this.names = [...this.svg.querySelectorAll(".names text")];
    this.turn = find(".turn");
    this.tilt = find(".tilt");
    this.play = find(".play");
    this.select = find(".mode");
    this.look();
    this.connect();
  }

  connect() {
    const controls = this.figure.querySelector(".controls");
    if (controls) controls.hidden = false;
    for (const slider of [this.turn, this.tilt]) slider?.addEventListener("input", () => this.seen());
    this.select?.addEventListener("change", () => this.choose(Number(this.select.value)));
    this.play?.addEventListener("click", () => (this.playing ? this.stop() : this.start()));
    if (!this.play) return;
    still.addEventListener("change", () => { if (still.matches) this.stop(); });
    new IntersectionObserver((entries) => {
      const visible = entries.at(-1).isIntersecting;
      if (visible && !still.matches && !this.stopped) this.start();
      else if (!visible && this.playing) this.rest();
    }).observe(this.svg);
    addEventListener("beforeprint", () => { this.phase = 0.25; this.draw(); });
  }

  choose(mode) {
    this.mode = mode;
    const title = `Mode ${this.select.options[mode].textContent}`;
    this.parts.caption.textContent = title;
    this.svg.querySelector("title").textContent = title;
    if (!this.playing) this.phase = 0.25;
    this.seen();
  }

  // The view, fitted to all that is drawn in any mode and phase.
  look() {
    const { p, u, a, v, f, h } = this.scene;
    this.matrix = v ? turned(Number(this.turn?.value ?? v[0]), Number(this.tilt?.value ?? v[1])) : f;
    this.restAt = projected(p, this.matrix);
    this.moves = u.map((shape) => projected(shape, this.matrix).map((x) => x * a));
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
    for (let i = 0; i < this.restAt.length; i++) {
      const reach = Math.max(0, ...this.moves.map((move) => Math.abs(move[i])));
      low[i % 2] = Math.min(low[i % 2], this.restAt[i] - reach);
      high[i % 2] = Math.max(high[i % 2], this.restAt[i] + reach);
    }
    const room = [this.width - 2 * h, this.height - 2 * h];
    this.scale = Math.min(...room.map((size, i) => size / Math.max(high[i] - low[i], 1e-5)));
    this.middle = low.map((value, i) => (value + high[i]) / 2);
  }

  seen() {
    this.look();
    const put = (part, d) => part?.setAttribute("d", d);
    const at = this.places(0);
    put(this.parts.still, this.lines(at, this.scene.l));
    put(this.parts.stillDots, this.dots(at.slice(0, 2 * (this.scene.d || at.length))));
    this.triad();
    this.draw();
  }

  triad() {
    if (!this.scene.v) return;
    const lines = this.svg.querySelectorAll(".triad line"), letters = this.svg.querySelectorAll(".triad text");
    for (let i = 0; i < lines.length; i++) {
      const axis = "xyz".indexOf(letters[i].textContent);
      const [dx, dy] = [20 * this.matrix[0][axis], -20 * this.matrix[1][axis]];
      const [x, y] = [Number(lines[i].getAttribute("x1")), Number(lines[i].getAttribute("y1"))];
      lines[i].setAttribute("x2", place(x + dx));
      lines[i].setAttribute("y2", place(y + dy));
      letters[i].setAttribute("x", place(x + 1.45 * dx));
      letters[i].setAttribute("y", place(y + 4 + 1.45 * dy));
    }
  }

  across(x) { return this.width / 2 + (x - this.middle[0]) * this.scale; }
  down(y) { return this.height / 2 - (y - this.middle[1]) * this.scale; }

  places(share) {
    const move = this.moves[this.mode], found = new Array(this.restAt.length);
    for (let i = 0; i < found.length; i += 2) {
      found[i] = this.across(this.restAt[i] + (move ? share * move[i] : 0));
      found[i + 1] = this.down(this.restAt[i + 1] + (move ? share * move[i + 1] : 0));
    }
    return found.map(place);
  }

  lines(at, pairs) {
    let words = "", last = -1;
    for (let i = 0; i < pairs.length; i += 2) {
      const [a, b] = [2 * pairs[i], 2 * pairs[i + 1]];
      if (a !== last) words += `M${at[a]} ${at[a + 1]}`;
      words += `L${at[b]} ${at[b + 1]}`;
      last = b;
    }
    return words;
  }

  dots(at) {
    let words = "";
    for (let i = 0; i < at.length; i += 2) words += `M${at[i]} ${at[i + 1]}h0`;
    return words;
  }

  stems(at) {
    const rest = this.places(0);
    let words = "";
    for (let i = 0; i < at.length; i += 2) words += `M${rest[i]} ${rest[i + 1]}L${at[i]} ${at[i + 1]}`;
    return words;
  }

  draw() {
    const share = Math.sin(FULL_TURN * this.phase), at = this.places(share), { parts, scene } = this;
    parts.moved?.setAttribute("d", this.lines(at, scene.l));
    parts.stems?.setAttribute("d", this.stems(at));
    parts.stretch?.setAttribute("d", this.lines(at, scene.s));
    if (scene.d) parts.movedDots?.setAttribute("d", this.dots(at.slice(0, 2 * scene.d)));
    parts.test?.setAttribute("d", this.squares(share));
    this.mark(share);
  }

  squares(share) {
    const { t, p, a } = this.scene;
    return (t[this.mode] ?? []).map(([node, ...u]) => {
      const point = projected(u.map((x, i) => p[3 * node + i] + share * a * x), this.matrix);
      return `M${place(this.across(point[0]) - 4)} ${place(this.down(point[1]) - 4)}h8v8h-8z`;
    }).join("");
  }

  // Marked places move with the two nodes that they lie between.
  mark(share) {
    const move = this.moves[this.mode];
    this.scene.m.forEach(([x, y, z, i, j, w], number) => {
      const rest = projected([x, y, z], this.matrix);
      const [dx, dy] = move ? [0, 1].map((k) => share * ((1 - w) * move[2 * i + k] + w * move[2 * j + k])) : [0, 0];
      const [cx, cy] = [this.across(rest[0] + dx), this.down(rest[1] + dy)];
      this.rings[number].setAttribute("cx", place(cx));
      this.rings[number].setAttribute("cy", place(cy));
      const name = this.names.find((text) => Number(text.dataset.mark) === number);
      if (!name) return;
      name.setAttribute("x", place(cx + (name.getAttribute("text-anchor") === "end" ? -16 : 16)));
      name.setAttribute("y", place(cy - 14));
    });
  }

  start() {
    if (this.playing) return;
    this.playing = true;
    this.stopped = false;
    this.play.textContent = "Pause";
    let before = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.phase = (this.phase + Math.max(0, now - before) / PERIOD) % 1;
      before = now;
      this.draw();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  // Out of sight it rests, and goes on when it comes back; a stop by hand lasts.
  rest() {
    this.playing = false;
    this.play.textContent = "Play";
  }

  stop() {
    this.stopped = true;
    this.rest();
  }
}

for (const figure of document.querySelectorAll(".structure")) new Stage(figure);
