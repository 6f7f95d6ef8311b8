//! Logs of every layout give exactly the telegrams that were written into them.

mod bad_files;
mod conversations;
mod flow;
mod generator;
mod layouts;
mod noise;
mod programs;
mod slices;
