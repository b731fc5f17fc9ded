// Draws a figure made by `figure_json` into an element of the page.
function halfshaftDraw(element, figure) {
  "use strict";
  var layout = figure.layout;
  var meta = layout.meta;
  if (element.clientWidth < meta.narrow.below) {
    layout.title.text = meta.narrow.title;
    layout.title.pad.t = meta.narrow.pad;
    layout.margin.t = meta.narrow.top;
    layout.height = meta.narrow.height;
  }
  element.setAttribute("role", "figure");
  element.setAttribute("aria-label", meta.label);

  // Gives every secondary axis the range that belongs to its primary axis.
  function follow() {
    var update = {};
    meta.linked.forEach(function (link) {
      var shown = element.layout[link.axis].range;
      var wanted = element.layout[link.of].range.map(function (value) {
        return link.log ? value + Math.log10(link.factor) : link.factor * value + link.offset;
      });
      var miss = Math.abs(wanted[0] - shown[0]) + Math.abs(wanted[1] - shown[1]);
      if (miss > 1e-9 * Math.abs(wanted[1] - wanted[0])) {
        update[link.axis + ".range"] = wanted;
      }
    });
    if (Object.keys(update).length > 0) {
      Plotly.relayout(element, update);
    }
  }

  return Plotly.newPlot(element, figure.data, layout, figure.config).then(function () {
    element.on("plotly_relayout", follow);
    return element;
  });
}
