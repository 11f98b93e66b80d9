//! Files that other libraries wrote, read and compared with what those libraries read of them (`tests/data/make.py`).

mod damage;
mod digest;
#[cfg(feature = "hdf5")]
mod hdf5;
#[cfg(feature = "hdf5")]
mod hdf5_writer;
mod matlab;
mod peers;
mod pickle;
mod recordings;
mod refusals;
mod threads;
mod zarr;
