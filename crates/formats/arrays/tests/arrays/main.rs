//! Files that other libraries wrote, read and compared with what those libraries read of them (`tests/data/make.py`).

mod damage;
mod digest;
#[cfg(feature = "hdf5")]
mod hdf5;
mod matlab;
mod peers;
mod pickle;
mod recordings;
mod refusals;
mod threads;
#[cfg(feature = "hdf5")]
mod written;
mod zarr;
