// Rows of the jobs by a word in them and by how they ended.
const filters = document.querySelector(".filters");
if (filters) {
  const [word, ended] = ["word", "ended"].map((id) => document.getElementById(id));
  const rows = [...document.querySelector("tbody").rows];
  const filter = () => {
    const wanted = word.value.toLowerCase();
    for (const row of rows) {
      const like = !ended.value || row.cells[2].textContent === ended.value;
      row.hidden = !like || !row.textContent.toLowerCase().includes(wanted);
    }
    say(`${rows.filter((row) => !row.hidden).length} of ${rows.length} jobs`);
  };
  for (const each of [word, ended]) each.addEventListener("input", filter);
  filters.hidden = false;
}
