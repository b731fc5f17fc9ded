//! Lines that ask for trouble.
