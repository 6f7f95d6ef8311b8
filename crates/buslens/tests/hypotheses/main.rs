//! Causes of failed checks are found again: the misprints of a real manual, and telegrams damaged in
//! every usual way.

mod damage;
mod misprints;
