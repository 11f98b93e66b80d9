"use strict";
(() => {
  const tip = document.getElementById("tip");
  let lit = null;
  const dim = () => { if (lit) lit.classList.remove("on"); lit = null; tip.hidden = true; };
  const show = (mark, x, y) => {
    dim();
    lit = mark; mark.classList.add("on");
    tip.textContent = mark.dataset.t;
    tip.hidden = false;
    const box = tip.getBoundingClientRect();
    tip.style.left = Math.max(4, Math.min(x + 12, innerWidth - box.width - 8)) + "px";
    tip.style.top = (y + 16 + box.height > innerHeight ? y - box.height - 10 : y + 16) + "px";
  };
  document.addEventListener("pointermove", (event) => {
    const mark = event.target.closest && event.target.closest("[data-t]");
    if (mark) show(mark, event.clientX, event.clientY); else if (lit && event.pointerType !== "") dim();
  });
  document.addEventListener("keydown", (event) => {
    if (event.key === "Escape") return dim();
    const svg = event.target.closest && event.target.closest("svg");
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!svg || !step) return;
    const marks = [...svg.querySelectorAll("[data-t]")];
    if (!marks.length) return;
    event.preventDefault();
    const at = (marks.indexOf(lit) + step + marks.length) % marks.length;
    const box = marks[at].getBoundingClientRect();
    show(marks[at], box.right, box.bottom);
  });
  document.addEventListener("focusout", dim);
  addEventListener("scroll", dim, { passive: true });

  for (const table of document.querySelectorAll("table.sorts")) {
    const heads = [...table.tHead.rows[0].cells];
    heads.forEach((head, column) => {
      const name = head.textContent;
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = name;
      head.replaceChildren(button);
      button.addEventListener("click", () => {
        const down = head.getAttribute("aria-sort") === "ascending";
        heads.forEach((other) => other.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        const key = (row) => row.cells[column].dataset.v ?? row.cells[column].textContent;
        const order = (a, b) => {
          const [left, right] = [key(a), key(b)];
          const [x, y] = [left, right].map((text) => (text === "" ? NaN : Number(text)));
          if (Number.isNaN(x) !== Number.isNaN(y)) return Number.isNaN(x) ? 1 : -1;
          const sign = Number.isNaN(x) ? left.localeCompare(right) : x - y;
          return down ? -sign : sign;
        };
        for (const body of table.tBodies) body.append(...[...body.rows].sort(order));
      });
    });
  }

  const filters = [...document.querySelectorAll("[data-filter]")];
  const apply = () => {
    for (const item of document.querySelectorAll("[data-tags]")) {
      const tags = item.dataset.tags.split(" ");
      item.hidden = !filters.every((filter) => {
        const wanted = filter.value.trim().toLowerCase();
        if (!wanted) return true;
        return filter.dataset.filter === "text"
          ? item.textContent.toLowerCase().includes(wanted)
          : tags.includes(wanted);
      });
    }
  };
  filters.forEach((filter) => filter.addEventListener("input", apply));

  const folds = [...document.querySelectorAll("details")];
  const reveal = () => {
    const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    if (!target) return;
    for (let at = target; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    target.scrollIntoView();
  };
  addEventListener("hashchange", reveal);
  reveal();
  let closed = [];
  addEventListener("beforeprint", () => {
    closed = folds.filter((fold) => !fold.open);
    closed.forEach((fold) => { fold.open = true; });
  });
  addEventListener("afterprint", () => { closed.forEach((fold) => { fold.open = false; }); });
  for (const button of document.querySelectorAll("[data-unfold]")) {
    button.hidden = false;
    const words = [button.textContent, "Fold everything"];
    button.addEventListener("click", () => {
      const open = folds.some((fold) => !fold.open);
      folds.forEach((fold) => { fold.open = open; });
      button.textContent = words[open ? 1 : 0];
    });
  }

  for (const button of document.querySelectorAll("[data-copy]")) {
    button.hidden = false;
    const words = button.textContent;
    button.addEventListener("click", async () => {
      const source = document.getElementById(button.dataset.copy);
      let done = false;
      try {
        await navigator.clipboard.writeText(source.textContent);
        done = true;
      } catch {
        const range = document.createRange();
        range.selectNodeContents(source);
        getSelection().removeAllRanges();
        getSelection().addRange(range);
        done = document.execCommand("copy");
      }
      button.textContent = done ? "Copied" : "Selected: copy it with Ctrl+C";
      setTimeout(() => { button.textContent = words; }, 2500);
    });
  }

  const boxes = document.querySelectorAll(".scroll, main figure[id]");
  const hint = (box) => { box.toggleAttribute("data-more", box.scrollWidth > box.clientWidth + 2); };
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => hint(entry.target)));
  boxes.forEach((box) => watch.observe(box));
})();
