(function () {
  "use strict";
  // Figures come alive when the reader is near, so that the page opens at once.
  function enliven(figure) {
    var data = figure.querySelector("script");
    var place = figure.querySelector(".live");
    if (!data || !place || typeof halfshaftDraw !== "function") { return; }
    figure.classList.add("drawing");
    try {
      halfshaftDraw(place, JSON.parse(data.textContent)).then(function () {
        figure.classList.remove("drawing");
        figure.classList.add("drawn");
      });
    } catch (problem) {
      figure.classList.remove("drawing");
    }
  }

  var figures = Array.prototype.slice.call(document.querySelectorAll("figure.plot"));
  if ("IntersectionObserver" in window) {
    var near = new IntersectionObserver(function (entries) {
      entries.forEach(function (entry) {
        if (entry.isIntersecting) {
          near.unobserve(entry.target);
          enliven(entry.target);
        }
      });
    }, { rootMargin: "500px 0px" });
    figures.forEach(function (figure) { near.observe(figure); });
  } else {
    figures.forEach(enliven);
  }

  // The contents show where the reader is.
  var links = Array.prototype.slice.call(document.querySelectorAll(".contents a"));
  if ("IntersectionObserver" in window && links.length > 0) {
    var seen = new IntersectionObserver(function (entries) {
      entries.forEach(function (entry) {
        if (!entry.isIntersecting) { return; }
        links.forEach(function (link) {
          var here = link.getAttribute("href") === "#" + entry.target.id;
          if (here) { link.setAttribute("aria-current", "true"); } else { link.removeAttribute("aria-current"); }
        });
      });
    }, { rootMargin: "-15% 0px -75% 0px" });
    links.forEach(function (link) {
      var target = document.getElementById(link.getAttribute("href").slice(1));
      if (target) { seen.observe(target); }
    });
  }

  var button = document.querySelector("button.save");
  var numbers = document.getElementById("answer");
  if (button && numbers) {
    button.hidden = false;
    button.addEventListener("click", function () {
      var blob = new Blob([numbers.textContent], { type: "application/json" });
      var link = document.createElement("a");
      link.href = URL.createObjectURL(blob);
      link.download = button.getAttribute("data-name");
      link.click();
      setTimeout(function () { URL.revokeObjectURL(link.href); }, 1000);
    });
  }
})();
