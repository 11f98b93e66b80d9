//! Parts of pages: scrolling tables, folds, links of metrics, and the glossary of metrics.

mod fold;
mod glossary;
mod pieces;

pub(crate) use fold::fold;
pub(crate) use glossary::{folded_glossary, glossary, metric_link, score_link};
pub(crate) use pieces::{filter, heads, right_heads, scroll, terms};
