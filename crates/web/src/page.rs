//! The files of the page.

/// Name, type and content of every file.
pub const FILES: &[(&str, &str, &str)] = &[
    ("index.html", "text/html; charset=utf-8", include_str!("../page/index.html")),
    ("style.css", "text/css; charset=utf-8", include_str!("../page/style.css")),
    ("app.js", SCRIPT, include_str!("../page/app.js")),
    ("chart.js", SCRIPT, include_str!("../page/chart.js")),
    ("engine.js", SCRIPT, include_str!("../page/engine.js")),
    ("fields.js", SCRIPT, include_str!("../page/fields.js")),
    ("files.js", SCRIPT, include_str!("../page/files.js")),
    ("film.js", SCRIPT, include_str!("../page/film.js")),
    ("foreign.js", SCRIPT, include_str!("../page/foreign.js")),
    ("form.js", SCRIPT, include_str!("../page/form.js")),
    ("results.js", SCRIPT, include_str!("../page/results.js")),
    ("sketch.js", SCRIPT, include_str!("../page/sketch.js")),
    ("worker.js", SCRIPT, include_str!("../page/worker.js")),
    ("zip.js", SCRIPT, include_str!("../page/zip.js")),
];

const SCRIPT: &str = "text/javascript; charset=utf-8";
