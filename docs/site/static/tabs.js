// SPDX-License-Identifier: BSD-3-Clause
// When the reader chooses C or Python in one pair of tabs, shows this language in all pairs, on all pages.
document.addEventListener("DOMContentLoaded", () => {
  const inputs = [...document.querySelectorAll(".tabs > input")];
  const title = (input) => input.nextElementSibling.textContent;
  const choose = (language) => {
    for (const input of inputs) if (title(input) === language) input.checked = true;
  };
  choose(localStorage.getItem("baum-language"));
  for (const input of inputs)
    input.addEventListener("change", () => {
      localStorage.setItem("baum-language", title(input));
      choose(title(input));
    });
});
