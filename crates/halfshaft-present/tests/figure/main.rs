//! Tests of figures from the outside: what is written is well formed, safe and complete.

mod any;
mod plotly;
mod png;
mod samples;
mod svg;
