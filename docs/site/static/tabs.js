// SPDX-License-Identifier: BSD-3-Clause
// Keeps the language that the reader chooses for all pairs of C and Python, on all pages.
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
