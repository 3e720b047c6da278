// A page from a folder may not load its modules: without them it says what to do instead.
if (location.protocol === "file:") document.documentElement.classList.add("folder");
