//! Programs of others on the other end of our sockets: they prove that both our ends are not wrong in the same way.

mod ffmpeg;
mod python;
mod xarm;
