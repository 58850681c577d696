"""Allan deviation of a long still recording: noise by averaging time, its coefficients, and how long to average."""
