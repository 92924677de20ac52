"""Physics that the library has no name for, put into a truth; `also` declares beforehand which names are as true."""
