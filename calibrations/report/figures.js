// Zoom, cursor and reset of the figures on this page. A panel says in data-x and data-y where its axes begin and end;
// in its paths absolute coordinates are data and relative ones are shape, so that a mark keeps its size.
"use strict";
(() => {
  const SVG = "http://www.w3.org/2000/svg";
  const comma = document.documentElement.lang !== "en";
  const { reset: resetWord, hint } = document.body.dataset;
  const element = (name, attributes, parent) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    if (parent) parent.append(made);
    return made;
  };
  const written = (number, digits) => {
    const size = Math.abs(number);
    const text = size && (size >= 1e6 || size < 1e-4) ? number.toExponential(2) : number.toFixed(digits);
    const shown = /[1-9]/.test(text) ? text : text.replace("-", "");
    return comma ? shown.replace(".", ",") : shown;
  };

  class Axis {
    constructor(group, name, size) {
      const [low, high, kind] = group.dataset[name].split(" ");
      const upwards = name === "y";
      const whole = [this.inner(low, kind), this.inner(high, kind)];
      const [numbers, rules] = ["numbers", "rules"].map((part) => group.querySelector(`.${part}.${name}`));
      Object.assign(this, { kind, upwards, whole, numbers, rules, size, length: size[upwards ? 1 : 0] });
      this.free = kind !== "names";
      this.ends = [...whole];
      this.still = [numbers.innerHTML, rules.getAttribute("d")];
    }
    inner(text, kind) { return kind === "log" ? Math.log10(Number(text)) : Number(text); }
    part(place) { return this.upwards ? 1 - place / this.length : place / this.length; }
    at(place, ends = this.ends) { return ends[0] + this.part(place) * (ends[1] - ends[0]); }
    place(value) {
      const part = (value - this.ends[0]) / (this.ends[1] - this.ends[0]);
      return (this.upwards ? 1 - part : part) * this.length;
    }
    moved(place) { return this.place(this.at(place, this.whole)); }
    width(ends) { return Math.abs(ends[1] - ends[0]); }
    digits(span) { return Math.min(9, Math.max(0, 1 - Math.floor(Math.log10(Math.abs(span) || 1)))); }
    text(value) {
      if (this.kind === "log") return written(10 ** value, this.digits(10 ** value / 10));
      return written(value, this.digits((this.ends[1] - this.ends[0]) / 100));
    }
    ticks() {
      const [low, high] = [Math.min(...this.ends), Math.max(...this.ends)];
      const least = (high - low) / Math.max(2, Math.floor(this.length / (this.upwards ? 40 : 70)));
      const power = 10 ** Math.floor(Math.log10(least));
      const step = [1, 2, 5, 10].find((factor) => factor * power >= least * 0.999999) * power;
      const places = [];
      for (let n = Math.ceil(low / step - 1e-9); n <= high / step + 1e-9; n += 1) places.push(n * step);
      const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
      return places.map((value) => [value, this.kind === "log" ? this.text(value) : written(value, digits)]);
    }
    draw() {
      const [width, height] = this.size;
      let drawn = "";
      this.numbers.replaceChildren();
      for (const [value, text] of this.ticks()) {
        const place = this.place(value);
        const where = this.upwards ? { x: -5, y: place + 4 } : { x: place, y: height + 14 };
        element("text", { ...where, "text-anchor": this.upwards ? "end" : "middle" }, this.numbers).textContent = text;
        drawn += this.upwards ? `M0 ${place}H${width}` : `M${place} 0V${height}`;
      }
      this.rules.setAttribute("d", drawn);
    }
    reset() {
      this.ends = [...this.whole];
      this.numbers.innerHTML = this.still[0];
      this.rules.setAttribute("d", this.still[1]);
    }
  }

  class Panel {
    constructor(group, number) {
      const [width, height] = group.dataset.size.split(" ").map(Number);
      Object.assign(this, { group, width, height, svg: group.ownerSVGElement });
      this.axes = ["x", "y"].map((name) => new Axis(group, name, [width, height]));
      [this.x, this.y] = this.axes;
      this.paths = [...group.querySelectorAll(".plot path:not(.whole)")].map((path) => [path, path.getAttribute("d")]);
      this.points = [...group.querySelectorAll(".plot path.marks")].flatMap((path) =>
        [...path.getAttribute("d").matchAll(/M(-?[\d.]+) (-?[\d.]+)/g)].map((found) => [+found[1], +found[2]]));
      const clip = element("clipPath", { id: `${this.svg.id}-clip-${number}` }, group);
      element("rect", { x: -4, y: -4, width: width + 8, height: height + 8 }, clip);
      group.querySelector(".plot").setAttribute("clip-path", `url(#${clip.id})`);
      this.cursor = element("g", { class: "cursor", visibility: "hidden" }, group);
      this.line = element("path", { fill: "none", stroke: "#777", "stroke-dasharray": "3 3" }, this.cursor);
      this.paper = element("rect", { y: -17, height: 15, fill: "#fff", opacity: 0.9 }, this.cursor);
      this.label = element("text", { y: -6, "font-weight": "bold" }, this.cursor);
      this.frame = element("path", { fill: "#0072b2", "fill-opacity": 0.12, stroke: "#0072b2" }, group);
      this.glass = element("rect", { width, height, fill: "transparent", "data-glass": "" }, group);
      element("title", {}, this.glass).textContent = hint;
      this.listen();
    }
    listen() {
      this.glass.addEventListener("pointermove", (event) => this.move(event));
      for (const left of ["pointerleave", "blur"]) {
        this.glass.addEventListener(left, () => this.cursor.setAttribute("visibility", "hidden"));
      }
      this.glass.setAttribute("tabindex", 0);
      this.glass.setAttribute("role", "img");
      this.glass.setAttribute("aria-label", hint);
      this.glass.addEventListener("keydown", (event) => this.key(event));
      if (!this.axes.some((axis) => axis.free)) return;
      this.glass.style.cursor = "crosshair";
      this.glass.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
      this.glass.addEventListener("pointerdown", (event) => this.press(event));
      this.glass.addEventListener("pointerup", (event) => this.release(event));
      this.glass.addEventListener("dblclick", () => this.reset());
    }
    where(event) {
      const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.group.getScreenCTM().inverse());
      return [Math.min(Math.max(point.x, 0), this.width), Math.min(Math.max(point.y, 0), this.height)];
    }
    wheel(event) {
      if (!event.ctrlKey) return; // the page scrolls on
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1.25 : 0.8, this.where(event));
    }
    key(event) {
      const step = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
      const zoom = { "+": 0.8, "=": 0.8, "-": 1.25 }[event.key];
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (step && event.shiftKey) this.pan(event.key.match(/Up|Down/) ? 1 : 0, step);
      else if (step) this.next(step);
      else if (zoom) this.zoom(zoom, this.at ? this.moved(this.at) : [this.width / 2, this.height / 2]);
      else if (event.key === "0" || event.key === "Escape") this.reset();
      else return;
      event.preventDefault();
      if (this.at) this.show(...this.moved(this.at));
    }
    moved(point) { return this.axes.map((axis, which) => axis.moved(point[which])); }
    next(step) {
      this.ordered ??= [...this.points].sort((a, b) => a[0] - b[0] || b[1] - a[1]);
      if (!this.ordered.length) return;
      const from = this.at ? this.told(...this.moved(this.at)) : "";
      let place = this.at ? this.ordered.indexOf(this.at) : step > 0 ? -1 : this.ordered.length;
      do place += step; while (place in this.ordered && this.told(...this.moved(this.ordered[place])) === from);
      if (place in this.ordered) this.at = this.ordered[place];
    }
    pan(which, step) {
      const axis = this.axes[which];
      if (!axis.free || !this.zoomed) return;
      const by = (step * (axis.ends[1] - axis.ends[0])) / 5;
      axis.ends = axis.ends.map((end) => end + by);
      this.draw();
    }
    zoom(factor, places) {
      this.axes.forEach((axis, which) => {
        if (!axis.free) return;
        const centre = axis.at(places[which]);
        axis.ends = axis.ends.map((end) => centre + (end - centre) * factor);
      });
      if (this.axes.every((axis) => !axis.free || axis.width(axis.ends) >= axis.width(axis.whole))) this.reset();
      else this.draw();
    }
    press(event) {
      this.begun = this.where(event);
      this.glass.setPointerCapture(event.pointerId);
    }
    release(event) {
      const [begun, ended] = [this.begun, this.where(event)];
      this.begun = null;
      this.frame.setAttribute("d", "");
      if (!begun || Math.abs(begun[0] - ended[0]) < 6 || Math.abs(begun[1] - ended[1]) < 6) return;
      this.axes.forEach((axis, which) => {
        if (!axis.free) return;
        const places = [begun[which], ended[which]].sort((a, b) => (axis.upwards ? b - a : a - b));
        axis.ends = places.map((place) => axis.at(place));
      });
      this.draw();
    }
    move(event) {
      const [x, y] = this.where(event);
      if (this.begun) {
        const [left, top] = this.begun;
        this.frame.setAttribute("d", `M${left} ${top}H${x}V${y}H${left}z`);
        return;
      }
      let best = null;
      for (const [px, py] of this.points) {
        const [mx, my] = [this.x.moved(px), this.y.moved(py)];
        const far = (mx - x) ** 2 + (my - y) ** 2;
        if (far < 400 && (!best || far < best[0])) best = [far, mx, my];
      }
      this.show(...(best ? best.slice(1) : [x, y]));
    }
    told(cx, cy) {
      return [[this.x, cx], [this.y, cy]].filter(([axis]) => axis.free)
        .map(([axis, place]) => axis.text(axis.at(place))).join("; ");
    }
    show(cx, cy) {
      this.line.setAttribute("d", `M${cx} 0V${this.height}M0 ${cy}H${this.width}`);
      this.label.textContent = this.told(cx, cy);
      this.glass.setAttribute("aria-label", this.label.textContent);
      const wide = this.label.textContent.length * 6.6 + 8;
      const left = Math.min(Math.max(cx, 4), Math.max(this.width - wide, 4));
      this.label.setAttribute("x", left);
      this.paper.setAttribute("x", left - 4);
      this.paper.setAttribute("width", wide);
      this.cursor.setAttribute("visibility", "visible");
    }
    reset() {
      this.zoomed = false;
      for (const axis of this.axes) axis.reset();
      for (const [path, whole] of this.paths) path.setAttribute("d", whole);
      this.changed();
    }
    draw() {
      this.zoomed = true;
      for (const axis of this.axes.filter((each) => each.free)) axis.draw();
      for (const [path, whole] of this.paths) {
        path.setAttribute("d", whole.replace(/([ML])(-?[\d.]+) (-?[\d.]+)/g, (_, pen, px, py) =>
          `${pen}${this.x.moved(+px).toFixed(2)} ${this.y.moved(+py).toFixed(2)}`));
      }
      this.changed();
    }
    changed() { this.svg.dispatchEvent(new CustomEvent("zoomed")); }
  }

  for (const svg of document.querySelectorAll("svg.figure")) {
    const panels = [...svg.querySelectorAll("g.panel")].map((group, number) => new Panel(group, number));
    svg.setAttribute("role", "group");
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: resetWord, hidden: true });
    button.addEventListener("click", () => panels.forEach((panel) => panel.reset()));
    svg.addEventListener("zoomed", () => { button.hidden = !panels.some((panel) => panel.zoomed); });
    svg.after(button);
  }
})();
