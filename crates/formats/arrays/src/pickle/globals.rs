//! Names of classes and functions that a pickle may use. The reader never calls them, but constructs their values itself.

use crate::error::Problem;
use crate::scalar::shown;

/// Module, name, and internal name of each known class or function.
const KNOWN: &[(&str, &str, &str)] = &[
    ("numpy", "ndarray", "ndarray"),
    ("numpy", "dtype", "dtype"),
    ("numpy.core.multiarray", "_reconstruct", "_reconstruct"),
    ("numpy._core.multiarray", "_reconstruct", "_reconstruct"),
    ("numpy.core.multiarray", "scalar", "scalar"),
    ("numpy._core.multiarray", "scalar", "scalar"),
    ("numpy.core.numeric", "_frombuffer", "_frombuffer"),
    ("numpy._core.numeric", "_frombuffer", "_frombuffer"),
    ("_codecs", "encode", "encode"),
    // Empty bytes of protocol 2.
    ("__builtin__", "bytes", "bytes"),
    ("collections", "OrderedDict", "OrderedDict"),
];

/// Internal name of a known class or function. Returns an error with the name if it is unknown.
pub(crate) fn known(module: &str, name: &str, at: u64) -> Result<&'static str, Problem> {
    let found = KNOWN
        .iter()
        .find(|(of, known, _)| *of == module && *known == name);
    found
        .map(|(_, _, here)| *here)
        .ok_or_else(|| Problem::Global {
            at,
            global: shown(&format!("{module}.{name}")),
            mend: mend(module).to_owned(),
        })
}

/// Advice on how to write an object of this module without a pickle of its class.
fn mend(module: &str) -> &'static str {
    match module.split('.').next() {
        Some("pandas") => {
            "write the table in Python: `pandas.read_pickle(path).to_csv('table.csv', index=False)`, or each table of a list to a \
             separate file"
        }
        Some("torch") => "write arrays in Python: `np.savez('run.npz', x=x.numpy())`",
        _ => "write plain values or arrays: `np.savez('run.npz', x=x)`",
    }
}
