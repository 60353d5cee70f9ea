// Behaviour of a report: navigation, filters, hovering over charts, the table, row details, pictures.
// Everything that rows say reaches the page as text, never as markup.
"use strict";
(async () => {
  const byId = (id) => document.getElementById(id);

  // Long texts are zlib data in base64.
  async function unpacked(base64) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).text();
  }
  async function readData(id) {
    const element = byId(id);
    const text = "packed" in element.dataset ? await unpacked(element.textContent) : element.textContent;
    return JSON.parse(text);
  }
  for (const element of document.querySelectorAll(".packed"))
    element.outerHTML = await unpacked(element.textContent);
  const data = await readData("table-data");
  const columns = data.columns || [];
  const inf = { inf: Infinity, "-inf": -Infinity };

  const valueOf = (column, row) => {
    const value = column.values[row];
    return column.texts ? column.texts[value] : value === null ? null : typeof value === "string" ? inf[value] : value;
  };
  const numberText = (value) => {
    if (value === null) return "–";
    if (!isFinite(value)) return value > 0 ? "∞" : "−∞";
    if (value === 0) return "0";
    const size = Math.abs(value);
    if (size < 1e-3 || size >= 1e7) return value.toExponential(2);
    return size >= 1000 ? Math.round(value).toLocaleString("en") : String(Number(value.toPrecision(4)));
  };
  const textOf = (column, row) => (column.texts ? valueOf(column, row) : numberText(valueOf(column, row)));
  const commandOf = (row) => data.reproduce.commands[row].map((word) => data.reproduce.words[word]).join(" ");

  function buildNavigation() {
    const nav = document.querySelector("nav");
    for (const section of document.querySelectorAll("main section")) {
      const link = document.createElement("a");
      link.href = "#" + section.id;
      link.textContent = section.querySelector("h2").textContent;
      nav.append(link);
    }
  }

  // Filters choose panels by scene, rays and device.
  function buildFilters() {
    const form = byId("filters");
    const panels = [...document.querySelectorAll(".panel")];
    const chosen = {};
    const apply = () => {
      for (const panel of panels)
        panel.hidden = Object.entries(chosen).some(
          ([key, value]) => value !== "" && key in panel.dataset && panel.dataset[key] !== value);
    };
    for (const [key, name] of [["scene", "Scene"], ["rays", "Rays"], ["device", "Device"]]) {
      const values = [...new Set(panels.map((panel) => panel.dataset[key]).filter((value) => value !== undefined))];
      if (values.length < 2) continue;
      const label = document.createElement("label");
      const select = document.createElement("select");
      select.append(new Option("all", ""), ...values.map((value) => new Option(value, value)));
      select.dataset.filter = key;
      // A page of very many panels begins with one scene.
      chosen[key] = key === "scene" && panels.length > 60 ? values[0] : "";
      select.value = chosen[key];
      select.addEventListener("change", () => { chosen[key] = select.value; apply(); });
      label.append(name + " ", select);
      form.append(label);
      form.hidden = false;
    }
    apply();
  }

  // A mark's row beside the pointer, or beside the mark that the arrow keys chose.
  function buildTips() {
    const tip = byId("tip");
    const shown = ["trace", "±", "memory", "build", "dt p99", "wrong", "own dt p99"];
    let pointed = null;
    const hide = () => {
      tip.hidden = true;
      if (pointed) pointed.classList.remove("pointed");
      pointed = null;
    };
    const show = (mark, x, y) => {
      if (pointed !== mark) {
        hide();
        pointed = mark;
        mark.classList.add("pointed");
        const row = Number(mark.dataset.r);
        tip.textContent = "";
        const title = document.createElement("b");
        title.textContent = textOf(columns[0], row);
        const table = document.createElement("table");
        for (const column of columns.filter((one) => shown.includes(one.heading))) {
          const line = table.insertRow();
          line.insertCell().textContent = column.heading;
          line.insertCell().textContent = textOf(column, row) + " " + column.unit;
        }
        tip.append(title, table);
      }
      tip.hidden = false;
      const box = tip.getBoundingClientRect();
      const left = x + 14 + box.width > innerWidth ? x - 14 - box.width : x + 14;
      const top = Math.min(y + 14, innerHeight - box.height - 6);
      tip.style.left = Math.max(4, left) + "px";
      tip.style.top = Math.max(4, top) + "px";
    };
    // Places of a mark in its drawing: of a point one, of a line one for each of its points.
    const placesOf = (mark) => mark.matches("use") ? [[mark.x.baseVal.value, mark.y.baseVal.value]]
      : mark.matches(".line") ? mark.getAttribute("d").match(/[^ML]+/g).map((pair) => pair.split(" ").map(Number)) : [];
    const onScreen = (mark, [x, y]) => {
      const point = new DOMPoint(x, y).matrixTransform(mark.ownerSVGElement.getScreenCTM());
      return [point.x, point.y];
    };
    const centre = (mark) => {
      const box = mark.getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    const nearest = (chart, x, y) => {
      let best = null, least = 18;
      for (const mark of chart.querySelectorAll("use[data-r], .line"))
        for (const place of placesOf(mark)) {
          const [mx, my] = onScreen(mark, place);
          const distance = Math.hypot(mx - x, my - y);
          if (distance < least) [best, least] = [mark, distance];
        }
      return best;
    };
    const markAt = (event) => {
      const chart = event.target.closest("svg.chart");
      return chart && (event.target.closest("[data-r]") || nearest(chart, event.clientX, event.clientY));
    };
    document.addEventListener("pointermove", (event) => {
      const mark = event.target.closest ? markAt(event) : null;
      if (mark) show(mark, event.clientX, event.clientY);
      else if (pointed && !document.activeElement.matches("svg.chart")) hide();
    });
    document.addEventListener("click", (event) => {
      const mark = markAt(event) || event.target.closest(".row-link");
      if (mark) { hide(); showDetails(Number(mark.dataset.r)); }
    });
    for (const chart of document.querySelectorAll("svg.chart")) {
      if (!chart.querySelector("[data-r]")) continue;
      chart.setAttribute("tabindex", "0");
      let place = -1;
      chart.addEventListener("keydown", (event) => {
        const marks = chart.querySelectorAll("[data-r]");
        if (event.key === "Enter" && pointed) showDetails(Number(pointed.dataset.r));
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (!step || marks.length === 0) return;
        event.preventDefault();
        place = (place + step + marks.length) % marks.length;
        show(marks[place], ...centre(marks[place]));
      });
      chart.addEventListener("blur", hide);
    }
    // A mark that keys chose stays chosen when the page moves, as it does to bring a chart into view; the
    // pointer's mark is another one then.
    addEventListener("scroll", () => {
      if (pointed && pointed.closest("svg.chart") === document.activeElement) show(pointed, ...centre(pointed));
      else hide();
    }, { passive: true });
  }

  async function copy(text, button) {
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      const area = document.createElement("textarea");
      area.value = text;
      button.after(area);
      area.select();
      document.execCommand("copy");
      area.remove();
    }
    button.textContent = "Copied";
  }

  // All that is known of a row.
  function showDetails(row) {
    const dialog = byId("details");
    dialog.textContent = "";
    const add = (parent, name, text) => {
      const element = document.createElement(name);
      element.textContent = text;
      parent.append(element);
      return element;
    };
    add(dialog, "h3", textOf(columns[0], row));
    const list = document.createElement("dl");
    for (const column of columns.slice(1)) {
      add(list, "dt", column.heading).title = column.help;
      add(list, "dd", (textOf(column, row) + " " + column.unit).trim());
    }
    dialog.append(list);
    const warning = data.warnings.texts[data.warnings.values[row]];
    if (warning) add(dialog, "p", warning);
    const command = commandOf(row);
    add(dialog, "pre", command || "The row does not say which command made it (schema 1).").className = "command";
    const buttons = document.createElement("div");
    buttons.className = "buttons";
    if (command) {
      const button = add(buttons, "button", "Copy command");
      button.className = "copy";
      button.addEventListener("click", () => copy(command, button));
    }
    add(buttons, "button", "Close").addEventListener("click", () => dialog.close());
    dialog.append(buttons);
    dialog.showModal();
  }

  // The table: sorted by one column, filtered by words, a page at a time.
  function buildTable() {
    const first = 100, more = 500;
    const texts = columns.filter((column) => column.texts);
    const words = [...Array(data.rows).keys()].map((row) => texts.map((c) => valueOf(c, row)).join(" ").toLowerCase());
    let order = [...Array(data.rows).keys()], sorted = -1, direction = 1, length = first;

    const heads = d3.select("#table thead tr").selectAll("th").data(columns).enter().append("th")
      .attr("scope", "col").attr("class", (c) => (c.texts ? null : "n")).attr("title", (c) => c.help || null);
    const buttons = heads.append("button").attr("type", "button");
    buttons.text((c) => c.heading).filter((c) => c.unit).append("small").text((c) => c.unit);

    const fillFirst = (cell, row) => {
      const button = document.createElement("button");
      button.className = "row-link";
      button.dataset.r = row;
      const name = document.createElement("span");
      name.className = "primitive s" + data.series[row];
      name.textContent = textOf(columns[0], row);
      button.append(name);
      cell.append(button);
      for (const [bit, letter] of [[1, "T"], [2, "M"]]) {
        if (!(data.fronts[row] & bit)) continue;
        const mark = document.createElement("span");
        mark.className = "front";
        mark.textContent = letter;
        cell.append(mark);
      }
    };
    const draw = () => {
      const wanted = byId("find").value.toLowerCase().split(/\s+/).filter((word) => word);
      const fronts = byId("fronts").checked;
      const found = order.filter((row) => (!fronts || data.fronts[row] & 3) &&
        wanted.every((word) => words[row].includes(word)));
      byId("found").textContent = found.length + " of " + data.rows + " rows";
      byId("more").hidden = found.length <= length;
      heads.attr("aria-sort", (c, i) => (i === sorted ? (direction > 0 ? "ascending" : "descending") : null));
      d3.select("#table tbody").selectAll("tr").data(found.slice(0, length), (row) => row).join(
        (enter) => enter.append("tr").each(function (row) {
          columns.forEach((column, i) => {
            const cell = this.insertCell();
            if (!column.texts) cell.className = "n";
            if (i === 0) fillFirst(cell, row);
            else cell.textContent = textOf(column, row);
          });
        })).order();
    };
    const compare = (column) => (a, b) => {
      const [x, y] = [valueOf(column, a), valueOf(column, b)];
      if (x === y) return a - b;
      if (x === null) return 1;
      if (y === null) return -1;
      const less = column.texts ? x.localeCompare(y, "en", { numeric: true }) : x - y;
      return direction * less || a - b;
    };
    buttons.nodes().forEach((button, i) => button.addEventListener("click", () => {
      direction = i === sorted ? -direction : 1;
      sorted = i;
      order.sort(compare(columns[i]));
      draw();
    }));
    byId("find").addEventListener("input", () => { length = first; draw(); });
    byId("fronts").addEventListener("change", draw);
    byId("more").addEventListener("click", () => { length += more; draw(); });
    draw();
  }

  // Two pictures over each other, zoomed together, with a cut between them.
  function buildPictures(pictures) {
    if (!pictures) return;
    const stage = byId("stage"), cutAt = byId("cut-at");
    const selects = [byId("picture-a"), byId("picture-b")];
    const images = [byId("image-a"), byId("image-b")];
    const groups = [...new Set(pictures.list.map((one) => one.group))];
    const nameOf = (one) => one.label + " – " + one.kind;
    byId("picture-group").append(...groups.map((group) => new Option(group, group)));

    const placeCut = () => {
      const view = d3.zoomTransform(stage), width = stage.clientWidth;
      const inImage = view.invertX(width * cutAt.value / 100) / width * 100;
      stage.style.setProperty("--cut", cutAt.value + "%");
      stage.style.setProperty("--cut-image", Math.min(100, Math.max(0, inImage)) + "%");
    };
    const zoom = d3.zoom().scaleExtent([1, 32]).on("zoom", () => {
      const view = d3.zoomTransform(stage);
      byId("layers").style.transform = `translate(${view.x}px, ${view.y}px) scale(${view.k})`;
      placeCut();
    });
    const fit = () => zoom.extent([[0, 0], [stage.clientWidth, stage.clientHeight]])
      .translateExtent([[0, 0], [stage.clientWidth, stage.clientHeight]]);
    d3.select(stage).call(zoom);
    const show = (side) => {
      const one = pictures.list[selects[side].value];
      images[side].src = pictures.uris[one.picture];
      images[side].alt = nameOf(one);
    };
    const fill = () => {
      const members = pictures.list.map((one, i) => i).filter((i) => pictures.list[i].group === byId("picture-group").value);
      selects.forEach((select, side) => {
        select.textContent = "";
        select.append(...members.map((i) => new Option(nameOf(pictures.list[i]), i)));
        select.value = members[Math.min(side, members.length - 1)];
        show(side);
      });
    };
    byId("picture-group").addEventListener("change", fill);
    selects.forEach((select, side) => select.addEventListener("change", () => show(side)));
    byId("picture-mode").addEventListener("change", (event) => { stage.dataset.mode = event.target.value; });
    byId("picture-reset").addEventListener("click", () => d3.select(stage).call(zoom.transform, d3.zoomIdentity));
    cutAt.addEventListener("input", placeCut);
    new ResizeObserver(() => { fit(); placeCut(); }).observe(stage);
    stage.dataset.mode = "slider";
    fill();
  }

  buildNavigation();
  buildFilters();
  buildTips();
  if (window.d3) {
    buildTable();
    buildPictures(await readData("picture-data"));
  } else {
    byId("found").textContent = "This program was built without D3: no table and no picture viewer.";
  }
  document.body.dataset.ready = "yes";
})();
