#include "cli/trade/trade_page.h"

namespace relief::cli {

const char* trade_page_style() {
  return R"css(body { font: 15px/1.45 sans-serif; color: #222; margin: 24px auto; max-width: 1240px; padding: 0 16px }
h1 { font-size: 24px } h2 { font-size: 18px; margin-top: 32px }
.plots { display: flex; flex-wrap: wrap; gap: 12px }
.key span { margin-right: 18px; white-space: nowrap }
.dot { display: inline-block; width: 11px; height: 11px; border-radius: 6px; margin-right: 5px }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 3px 9px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap }
th:first-child, td:first-child { text-align: left; white-space: normal; min-width: 240px }
th { white-space: normal; max-width: 110px }
#all th { cursor: pointer; position: sticky; top: 0; background: #f4f4f4 }
#all tr.same { background: #ffe9c7 }
#all tr.minor { display: none } #all.full tr.minor { display: table-row }
code { background: #f2f2f2; padding: 1px 4px; font-size: 12.5px }
#tip { position: fixed; display: none; background: #fff; border: 1px solid #888; padding: 7px 10px; font-size: 13px;
       max-width: 420px; box-shadow: 0 2px 8px #0003; pointer-events: none; white-space: pre-line }
)css";
}

const char* trade_page_script() {
  return R"js('use strict';
const report = JSON.parse(document.getElementById('report').textContent);
const tip = document.getElementById('tip');
const table = document.getElementById('all');
for (const title of document.querySelectorAll('svg title')) title.remove();

const value = (number, digits, unit) => number === null ? 'not measured' : number.toFixed(digits) + ' ' + unit;
function tell(row) {
  return row.name + (row.quality ? ' (' + row.quality + ')' : '') + '\n'
    + 'frame: ' + value(row.frame_ms, 1, 'ms') + '\n'
    + 'picture: ' + value(row.psnr_db, 2, 'dB') + ', FLIP ' + value(row.flip_mean, 4, '') + '\n'
    + 'normals: ' + value(row.normal_rms_deg, 2, 'degrees') + ', holes ' + row.holes + '\n'
    + 'surface: ' + value(row.surface_psnr_db, 2, 'dB') + ', ' + row.samples.toLocaleString('en') + ' samples\n'
    + 'on disk: ' + value(row.file_bytes / 1e6, 3, 'MB') + ', conversion: ' + value(row.convert_seconds, 2, 's') + '\n'
    + 'on the GPU: ' + (row.gpu_bytes === null ? 'not used' : value(row.gpu_bytes / 1e6, 1, 'MB'));
}
function mark(number) {
  for (const old of document.querySelectorAll('.same')) old.classList.remove('same');
  if (number === null) return;
  for (const same of document.querySelectorAll('[data-row="' + number + '"]')) same.classList.add('same');
}
document.addEventListener('mouseover', event => {
  const point = event.target.closest('[data-row]');
  mark(point ? point.dataset.row : null);
  tip.style.display = point && point.tagName === 'circle' ? 'block' : 'none';
  if (point) tip.textContent = tell(report.rows[point.dataset.row]);
});
document.addEventListener('mousemove', event => {
  const left = Math.min(event.clientX + 14, innerWidth - tip.offsetWidth - 8);
  const top = Math.min(event.clientY + 14, innerHeight - tip.offsetHeight - 8);
  tip.style.left = left + 'px';
  tip.style.top = top + 'px';
});
document.getElementById('full').addEventListener('change', event => table.classList.toggle('full', event.target.checked));

let sorted = -1;
for (const [column, head] of [...table.tHead.rows[0].cells].entries()) {
  head.addEventListener('click', () => {
    const sign = sorted === column ? -1 : 1;
    sorted = sign < 0 ? -1 : column;
    const key = row => {
      const cell = row.cells[column];
      return cell.dataset.value === undefined ? cell.textContent : Number(cell.dataset.value);
    };
    const rows = [...table.tBodies[0].rows].sort((a, b) => {
      const x = key(a), y = key(b);
      return sign * (typeof x === 'number' && typeof y === 'number' ? x - y : String(x).localeCompare(String(y)));
    });
    table.tBodies[0].append(...rows);
  });
}
)js";
}

}  // namespace relief::cli
