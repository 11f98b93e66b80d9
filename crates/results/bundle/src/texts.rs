//! Files generated from the manifest, only for comparison with the files of the bundle. No value is read from a generated file.

use crate::columns::TableColumns;
use crate::layout::{CARD, CITATION, CRATE, CROISSANT, EVAL_RESULTS, LICENCE};
use crate::manifest::Manifest;
use crate::{card, croissant, eval_results, ro_crate};

/// Generated texts by file name; `tables` are the columns of the bundle's tables.
pub(crate) fn all(manifest: &Manifest, tables: &[TableColumns]) -> [(&'static str, String); 6] {
    [
        (CITATION, card::citation(manifest)),
        (LICENCE, card::licence(manifest)),
        (CARD, card::card(manifest)),
        (EVAL_RESULTS, eval_results::text(manifest)),
        (CROISSANT, croissant::text(manifest, tables)),
        (CRATE, ro_crate::text(manifest)),
    ]
}
